/* A node of a road network dragged about: a square of streets whose crossings have moved at random.
 * Milliseconds of the processor, one thread: making the map, the first frame, and the median of all
 * frames, without making the target; then the median of making the target. Arguments: numbers of
 * streets in each direction; without any, 15, 45 and 142. */
#include "bench.h"

#include "../random.h"

#include <stdbool.h>

enum { FRAMES = 40 };

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

typedef struct streets {
    size_t n;             /* in each direction */
    double *given, *node; /* n n crossings: before, and after */
    double *line;         /* the crossings of all streets */
    icc_feature *feature;
} streets;

static streets make_streets(size_t n)
{
    streets s = {n, bench_alloc(n * n, 2 * sizeof(double)), bench_alloc(n * n, 2 * sizeof(double)),
                 bench_alloc(n * n, 4 * sizeof(double)), bench_alloc(2 * n, sizeof(icc_feature))};
    random_source r = {1};
    for (size_t k = 0; k < n * n; ++k) {
        const size_t column = k % n, row = k / n;
        const double x = (double)column, y = (double)row;
        const bool is_inner = row > 0 && column > 0 && row < n - 1 && column < n - 1;
        const double dx = 0.25 * (random_unit(&r) - 0.5), dy = 0.25 * (random_unit(&r) - 0.5);
        const double to[2] = {is_inner ? 0.3 * sin(0.9 * y) : 0, is_inner ? 0.3 * cos(0.7 * x) : 0};
        s.given[2 * k] = x + (is_inner ? dx : 0) - 0.5 * (double)n;
        s.given[2 * k + 1] = y + (is_inner ? dy : 0) - 0.5 * (double)n;
        for (size_t d = 0; d < 2; ++d)
            s.node[2 * k + d] = s.given[2 * k + d] + to[d];
    }
    return s;
}

static void free_streets(streets *s)
{
    free(s->given);
    free(s->node);
    free(s->line);
    free(s->feature);
}

/* The rim is the outer ring, and the streets between are lines. */
static icc_domain *domain_of(streets *s, const double *node)
{
    const size_t n = s->n, last = n - 1;
    double *rim = bench_alloc(4 * last, 2 * sizeof *rim), *line = s->line;
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    size_t n_lines = 0;
    for (size_t k = 0; k < last; ++k) {
        const size_t side[] = {k, n * k + last, n * last + last - k, n * (last - k)};
        for (size_t i = 0; i < 4; ++i)
            memcpy(rim + 2 * (i * last + k), node + 2 * side[i], 2 * sizeof *rim);
    }
    for (size_t street = 2; street < 2 * last; ++street) {
        s->feature[n_lines++] = (icc_feature){.size = sizeof(icc_feature),
                                              .kind = ICC_FEATURE_LINE,
                                              .n_vertices = n,
                                              .vertices = line};
        for (size_t k = 0; k < n; ++k, line += 2)
            memcpy(line, node + 2 * (street % 2 == 0 ? n * (street / 2) + k : n * k + street / 2),
                   2 * sizeof *line);
    }
    bench_check(icc_domain_create_features(&domain, 4 * last, rim, n_lines, s->feature, NULL, &err),
                &err);
    free(rim);
    return domain;
}

static void drag(size_t n)
{
    streets s = make_streets(n);
    icc_error err = {.size = sizeof err};
    icc_map_info info = {.size = sizeof info};
    icc_map *map, *next;
    icc_domain *source = domain_of(&s, s.given), *target = domain_of(&s, s.node);
    double ms[FRAMES], making[FRAMES], *const node = s.node + 2 * (n * (n / 2) + n / 2);
    const double from[2] = {node[0], node[1]};
    double begin = bench_processor_seconds();
    bench_check(icc_map_create(&map, source, target, NULL, NULL, &err), &err);
    const double create = 1e3 * (bench_processor_seconds() - begin);
    for (int frame = 0; frame < FRAMES; ++frame) {
        const double angle = 6.28318530717958647692 * (frame + 1) / FRAMES;
        node[0] = from[0] + 0.3 * sin(angle);
        node[1] = from[1] + 0.3 * (1 - cos(angle));
        icc_domain_free(target);
        begin = bench_processor_seconds();
        target = domain_of(&s, s.node);
        making[frame] = 1e3 * (bench_processor_seconds() - begin);
        begin = bench_processor_seconds();
        bench_check(icc_map_retarget(&next, map, target, NULL, NULL, &err), &err);
        ms[frame] = 1e3 * (bench_processor_seconds() - begin);
        icc_map_free(map);
        map = next;
    }
    (void)icc_map_get_info(map, &info);
    const double first = ms[0];
    qsort(ms, FRAMES, sizeof *ms, by_size);
    qsort(making, FRAMES, sizeof *making, by_size);
    printf("%6zu nodes, %6zu triangles: made in %.1f, first frame %.2f, median %.2f, target %.2f\n",
           n * n, info.n_simplices, create, first, ms[FRAMES / 2], making[FRAMES / 2]);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    free_streets(&s);
}

int main(int argc, char **argv)
{
    static const size_t SIZES[] = {15, 45, 142};
    for (int k = 1; k < argc; ++k)
        drag((size_t)strtoul(argv[k], NULL, 10));
    for (size_t k = 0; argc < 2 && k < sizeof SIZES / sizeof *SIZES; ++k)
        drag(SIZES[k]);
    return 0;
}
