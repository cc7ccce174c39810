/* Handles dragged about in a square, frame by frame: 20 points on circles whose diameter is a share
 * of the side, 240 frames to come round; with .2 of it they pass between one another. Milliseconds
 * of the processor a frame, one thread; frames that were refused; whether images of paths still
 * pass the handles as they should. Argument: how many sets of handles; without one, 3. */
#include "bench.h"

#include "../dragging.h"

enum { FRAMES = 240, HANDLES = 20 };

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct tally {
    double ms[FRAMES], energy, worst_gap;
    size_t n_refused, n_changed, n_triangles;
} tally;

/* A frame that is refused is left out: the next one goes on from the last map. */
static void follow(const drag *d, tally *t)
{
    static drag_word expected[DRAG_PATHS], found[DRAG_PATHS];
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_domain *source;
    icc_map *map;
    double last = 0;
    bench_check(drag_domain(&source, d, 0, &err), &err);
    bench_check(icc_map_create(&map, source, source, NULL, NULL, &err), &err);
    drag_words(map, d, 0, expected);
    for (int frame = 0; frame < FRAMES; ++frame) {
        const double angle = 6.28318530717958647692 * (frame + 1) / FRAMES;
        icc_domain *target;
        icc_map *next;
        const double begin = bench_processor_seconds();
        bench_check(drag_domain(&target, d, angle, &err), &err);
        const icc_status status = icc_map_retarget(&next, map, target, NULL, NULL, &err);
        t->ms[frame] = 1e3 * (bench_processor_seconds() - begin);
        icc_domain_free(target);
        if (status != ICC_OK) {
            if (t->n_refused++ == 0)
                printf("    frame %d: %s\n", frame, err.message);
            continue;
        }
        icc_map_free(map);
        map = next;
        drag_move(d, last, angle, DRAG_PATHS, expected);
        drag_words(map, d, angle, found);
        for (int k = 0; k < DRAG_PATHS; ++k)
            t->n_changed += !drag_same(&expected[k], &found[k]);
        (void)icc_map_get_info(map, &info);
        t->n_changed += !info.class_kept;
        t->energy = fmax(t->energy, info.energy);
        t->n_triangles = info.n_simplices > t->n_triangles ? info.n_simplices : t->n_triangles;
        last = angle;
    }
    icc_map_free(map);
    icc_domain_free(source);
}

int main(int argc, char **argv)
{
    const int n_sets = argc > 1 ? atoi(argv[1]) : 3;
    for (int k = 1; k <= 2; ++k)
        for (int set = 1; set <= n_sets; ++set) {
            static tally t;
            const drag d = drag_create(HANDLES, 0.1 * k, 0.12, 0.02, (uint64_t)set);
            t = (tally){0};
            follow(&d, &t);
            qsort(t.ms, FRAMES, sizeof *t.ms, by_size);
            printf("travel .%d, set %d: %6.2f ms median, %6.2f p95, %6.2f most; %3zu of %d frames "
                   "refused, class changed %zu times, energy at most %.1f, %zu triangles\n",
                   k, set, t.ms[FRAMES / 2], t.ms[FRAMES * 95 / 100], t.ms[FRAMES - 1], t.n_refused,
                   FRAMES, t.n_changed, t.energy, t.n_triangles);
            (void)fflush(stdout);
        }
    return EXIT_SUCCESS;
}
