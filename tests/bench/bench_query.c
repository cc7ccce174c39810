/* What a point through a map costs, forward and back: points in no order, and sorted along rows as
 * those of a picture are. Then what it costs to save a map and to load it again, and to follow a
 * target that moves. Arguments: cage files, source and target by turns. One thread, processor time,
 * the least of several runs; what is asked of it stands in the last columns. */
#include "cages.h"

#include <stdbool.h>

enum { RUNS = 7, POINTS = 300000, SIDE = 1024 };

/* Nanoseconds a point: in no order, for maps of fewer triangles than LARGE and for others; and
 * sorted. Megabytes a second. */
static const double RANDOM[2] = {60, 110}, SORTED = 45, SAVE = 2000, LOAD = 200;
enum { LARGE = 50000 };

/* ---- points ---- */

/* Their row of a grid over the box, and then their column, every other row backwards. */
typedef struct place {
    uint32_t cell;
    double p[2];
} place;

static int by_cell(const void *a, const void *b)
{
    const uint32_t x = ((const place *)a)->cell, y = ((const place *)b)->cell;
    return (x > y) - (x < y);
}

static void sort_points(const icc_domain *domain, size_t n, const double *points, double *sorted)
{
    const icc_domain_info info = cage_info(domain);
    place *places = bench_alloc(n, sizeof *places);
    for (size_t i = 0; i < n; ++i) {
        uint32_t at[2];
        for (int k = 0; k < 2; ++k) {
            places[i].p[k] = points[2 * i + (size_t)k];
            at[k] = (uint32_t)((SIDE - 1) * (places[i].p[k] - info.lower[k]) /
                               (info.upper[k] - info.lower[k]));
        }
        places[i].cell = SIDE * at[1] + (at[1] % 2 == 0 ? at[0] : SIDE - 1 - at[0]);
    }
    qsort(places, n, sizeof *places, by_cell);
    for (size_t i = 0; i < n; ++i)
        memcpy(sorted + 2 * i, places[i].p, sizeof places[i].p);
    free(places);
}

static double time_points(const icc_map *map, bool inverse, size_t n, const double *points,
                          double *images)
{
    double least = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        const double start = bench_processor_seconds();
        (void)(inverse ? icc_map_apply_inverse : icc_map_apply)(map, n, points, images, NULL, NULL,
                                                                NULL);
        least = fmin(least, bench_processor_seconds() - start);
    }
    return 1e9 * least / (double)n;
}

static void measure_points(const icc_map *map, const icc_domain *source, const icc_domain *target,
                           size_t n_triangles)
{
    double *points = bench_alloc(POINTS, 2 * sizeof *points);
    double *sorted = bench_alloc(POINTS, 2 * sizeof *sorted);
    double *images = bench_alloc(POINTS, 2 * sizeof *images);
    for (int inverse = 0; inverse < 2; ++inverse) {
        const icc_domain *from = inverse ? target : source;
        const size_t n = cage_points(from, POINTS, points);
        sort_points(from, n, points, sorted);
        const double random = time_points(map, inverse, n, points, images);
        printf(" %6.1f %6.1f", random, time_points(map, inverse, n, sorted, images));
    }
    printf(" (%3.0f %3.0f)", RANDOM[n_triangles >= LARGE], SORTED);
    free(points);
    free(sorted);
    free(images);
}

/* ---- bytes ---- */

static void measure_bytes(const icc_map *map)
{
    icc_error error = {.size = sizeof error};
    size_t n;
    (void)icc_map_save(map, 0, NULL, &n);
    unsigned char *data = bench_alloc(n, 1), *copy = bench_alloc(n, 1);
    double save = HUGE_VAL, load = HUGE_VAL, plain = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        icc_map *loaded;
        double start = bench_processor_seconds();
        (void)icc_map_save(map, n, data, &n);
        save = fmin(save, bench_processor_seconds() - start);
        start = bench_processor_seconds();
        bench_check(icc_map_load(&loaded, n, data, NULL, &error), &error);
        load = fmin(load, bench_processor_seconds() - start);
        icc_map_free(loaded);
        start = bench_processor_seconds();
        memcpy(copy, data, n);
        plain = fmin(plain, bench_processor_seconds() - start);
    }
    const double size = 1e-6 * (double)n;
    printf("  %6.2f %6.0f %6.0f %6.0f (%4.0f %3.0f)", size, size / plain, size / save, size / load,
           SAVE, LOAD);
    free(data);
    free(copy);
}

/* ---- frames ---- */

/* The target swells and shrinks by about a tenth of an edge, each frame from the one before. */
static void measure_frames(icc_map *map, const icc_domain *target)
{
    enum { FRAMES = 12 };
    icc_error error = {.size = sizeof error};
    const icc_domain_info info = cage_info(target);
    const double by = 0.1 / (double)info.n_vertices;
    double *given = bench_alloc(info.n_vertices, 2 * sizeof *given), times[FRAMES];
    double *moved = bench_alloc(info.n_vertices, 2 * sizeof *moved);
    bench_check(icc_domain_get_boundary(target, given, NULL), &error);
    for (int k = 0; k < FRAMES; ++k) {
        for (size_t i = 0; i < 2 * info.n_vertices; ++i)
            moved[i] = given[i] + by * (k % 2) * (given[i] - info.lower[i % 2]);
        const double start = bench_processor_seconds();
        icc_domain *next = bench_domain(info.n_vertices, moved);
        icc_map *frame;
        bench_check(icc_map_retarget(&frame, map, next, NULL, NULL, &error), &error);
        times[k] = 1e3 * (bench_processor_seconds() - start);
        icc_domain_free(next);
        icc_map_free(map);
        map = frame;
    }
    printf("  %8.2f", cage_quantile(times, FRAMES, 0.5));
    icc_map_free(map);
    free(given);
    free(moved);
}

int main(int argc, char **argv)
{
    printf("                         ns a point: there           back             (asked)"
           "     saved, MB/s                              frame,\n"
           "pair          n triangles   any   rows    any   rows"
           "               MB   copy   save   load (asked)         ms\n");
    for (int k = 1; k + 1 < argc; k += 2) {
        icc_domain *source = cage_read(argv[k]), *target = cage_read(argv[k + 1]);
        icc_error error = {.size = sizeof error};
        icc_map_info info = {.size = sizeof info};
        icc_map *map;
        bench_check(icc_map_create(&map, source, target, NULL, NULL, &error), &error);
        (void)icc_map_get_info(map, &info);
        printf("%-8.8s %6zu    %6zu", cage_name(argv[k]), cage_info(source).n_vertices,
               info.n_simplices);
        measure_points(map, source, target, info.n_simplices);
        measure_bytes(map);
        if (info.kind == ICC_MAP_MESH)
            measure_frames(map, target);
        else
            icc_map_free(map);
        printf("\n");
        fflush(stdout);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    return EXIT_SUCCESS;
}
