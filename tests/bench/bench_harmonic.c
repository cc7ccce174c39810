/* What a pair of foliation or disc charts costs, what a mapped point costs, and how fair the maps
 * of the three methods are. Arguments: cage files, source and target by turns. One thread. */
#include "cages.h"

enum { RUNS = 5, POINTS = 20000, ENERGY_POINTS = 20000 };

/* Runs of a pair that takes longer than this, in seconds, are not repeated as often. */
static const double LONG = 0.2;

static icc_map *create(const icc_domain *source, const icc_domain *target, int32_t method,
                       icc_status *status, icc_error *error)
{
    const icc_chart_options chart = {.size = sizeof chart, .method = method, .cells = 50};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    icc_map *map;
    *status = icc_map_create(&map, source, target, &options, NULL, error);
    return map;
}

/* The least time of several runs; the last map is kept. */
static icc_map *time_creation(const icc_domain *source, const icc_domain *target, int32_t method,
                              double *least)
{
    icc_map *map = NULL;
    icc_error error = {.size = sizeof error};
    *least = HUGE_VAL;
    for (int k = 0; k < RUNS && (k < 3 || *least < LONG); ++k) {
        icc_status status;
        icc_map_free(map);
        const double start = bench_seconds();
        map = create(source, target, method, &status, &error);
        *least = fmin(*least, bench_seconds() - start);
        if (map == NULL) {
            printf("  %s\n", error.message);
            return NULL;
        }
    }
    return map;
}

/* Seconds a point, and the largest error of the way there and back, of the source's diagonal. */
static void time_points(const icc_map *map, const icc_domain *source, double *seconds,
                        double *round_trip, size_t *n_failed)
{
    double *points = bench_alloc(POINTS, 2 * sizeof *points);
    double *images = bench_alloc(POINTS, 2 * sizeof *images);
    icc_error error = {.size = sizeof error};
    const size_t n = cage_points(source, POINTS, points);
    *seconds = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        const double start = bench_seconds();
        bench_check(icc_map_apply(map, n, points, images, NULL, n_failed, NULL), &error);
        *seconds = fmin(*seconds, (bench_seconds() - start) / (double)n);
    }
    bench_check(icc_map_apply_inverse(map, n, images, images, NULL, NULL, NULL), &error);
    *round_trip = 0;
    for (size_t i = 0; i < n; ++i)
        *round_trip = fmax(*round_trip, hypot(images[2 * i] - points[2 * i],
                                              images[2 * i + 1] - points[2 * i + 1]));
    *round_trip /= cage_diagonal(source);
    free(points);
    free(images);
}

static void print_sizes(const icc_map *map)
{
    double mesh = 0, solve = 0, certify = 0;
    const icc_chart *charts[2] = {icc_map_source_chart(map), icc_map_target_chart(map)};
    for (int k = 0; k < 2; ++k) {
        icc_foliation_info leaves = {.size = sizeof leaves};
        icc_disc_info disc = {.size = sizeof disc};
        icc_chart_timings took = {.size = sizeof took};
        (void)icc_chart_get_foliation_info(charts[k], &leaves);
        (void)icc_chart_get_disc_info(charts[k], &disc);
        (void)icc_chart_get_timings(charts[k], &took);
        printf(" %6zu", leaves.n_mesh_vertices + disc.n_mesh_vertices);
        mesh += 1e3 * took.mesh;
        solve += 1e3 * took.solve;
        certify += 1e3 * took.certify;
    }
    printf("  %6.1f %6.1f %5.1f", mesh, solve, certify);
}

static void measure(const char *name, const icc_domain *source, const icc_domain *target,
                    int32_t method)
{
    const char *method_name = method == ICC_METHOD_GRADIENT    ? "gradient"
                              : method == ICC_METHOD_FOLIATION ? "foliation"
                                                               : "disc";
    double create_seconds, point_seconds, round_trip;
    size_t n_failed;
    printf("%-8.8s %6zu %-9s", name, cage_info(source).n_vertices, method_name);
    icc_map *map = time_creation(source, target, method, &create_seconds);
    if (map == NULL)
        return;
    time_points(map, source, &point_seconds, &round_trip, &n_failed);
    const cage_energy energy = cage_measure_energy(map, source, target, ENERGY_POINTS);
    printf(" %7.1f ", 1e3 * create_seconds);
    print_sizes(map);
    printf("  %6.2f %8.1e %5zu  %9.3g %8.3g %8.3g %6.2f\n", 1e6 * point_seconds, round_trip,
           n_failed, energy.mean, energy.median, energy.high, 100 * energy.left_out);
    fflush(stdout);
    icc_map_free(map);
}

int main(int argc, char **argv)
{
    printf("                             pair   mesh vertices  of which, ms          a point, round"
           "    no    |J|^2 + |J^-1|^2 where det J > 1e-9, else %%\n"
           "pair          n method        ms  source target    mesh  solve check      us   trip"
           "   image      mean   median     99 %%   else\n");
    for (int k = 1; k + 1 < argc; k += 2) {
        icc_domain *source = cage_read(argv[k]), *target = cage_read(argv[k + 1]);
        measure(cage_name(argv[k]), source, target, ICC_METHOD_GRADIENT);
        measure(cage_name(argv[k]), source, target, ICC_METHOD_FOLIATION);
        measure(cage_name(argv[k]), source, target, ICC_METHOD_DISC);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    return EXIT_SUCCESS;
}
