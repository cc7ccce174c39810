/* How much the papers' method collapses, at which resolution: what the charts miss, and the sign
 * of the map's derivative at evenly spread points. Cage files (`x y` per line) may be given in
 * pairs, source and target. */
#include "bench.h"

enum { POINTS = 40000, MOST_VERTICES = 100000 };

/* Determinants this small relative to the ratio of the areas are rounding: they come out of sums
 * of up to some thousand terms of size 1. */
static const double FLAT = 1e-9;

/* Points spread evenly inside a domain by the R2 sequence (M. Roberts, 2018). A lattice will not
 * do: it meets the grid's own lattice in vertices, where curves merge. */
static void spread_points(const icc_domain *domain, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    icc_error error = {.size = sizeof error};
    bench_check(icc_domain_get_info(domain, &info), &error);
    for (size_t i = 0, n = 0; n < POINTS; ++i) {
        const double u = fmod(0.5 + 0.75487766624669276 * (double)i, 1);
        const double v = fmod(0.5 + 0.56984029099805327 * (double)i, 1);
        const double p[2] = {info.lower[0] + u * (info.upper[0] - info.lower[0]),
                             info.lower[1] + v * (info.upper[1] - info.lower[1])};
        int32_t where;
        bench_check(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL), &error);
        if (where == ICC_INSIDE)
            memcpy(points + 2 * n++, p, sizeof p);
    }
}

typedef struct shares {
    double collapsed, inverted, failed;
} shares;

static shares judge_derivatives(const icc_map *map, const icc_domain *source, double area_ratio)
{
    double *points = bench_alloc(POINTS, 2 * sizeof *points);
    double *jacobians = bench_alloc(POINTS, 4 * sizeof *jacobians);
    spread_points(source, points);
    icc_error error = {.size = sizeof error};
    bench_check(icc_map_jacobian(map, POINTS, points, jacobians, NULL, NULL, NULL), &error);
    shares s = {0};
    for (size_t i = 0; i < POINTS; ++i) {
        const double *j = jacobians + 4 * i;
        const double det = (j[0] * j[3] - j[1] * j[2]) / area_ratio;
        s.failed += isnan(det);
        s.inverted += det < -FLAT;
        s.collapsed += fabs(det) < FLAT;
    }
    s.failed /= POINTS;
    s.inverted /= POINTS;
    s.collapsed /= POINTS;
    free(points);
    free(jacobians);
    return s;
}

static double area(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    icc_error error = {.size = sizeof error};
    bench_check(icc_domain_get_info(domain, &info), &error);
    return info.measure;
}

static void measure(const char *name, const icc_domain *source, const icc_domain *target,
                    int32_t function, int32_t cells)
{
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_GRADIENT, .function = function,
                                     .cells = cells};
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_map *map;
    icc_error error = {.size = sizeof error};
    const icc_status status = icc_map_create(&map, source, target, &options, NULL, &error);
    printf("%-8.8s %-8s %5d", name, function == ICC_FUNCTION_DECAY ? "decay" : "distance", cells);
    if (status != ICC_OK) {
        printf("  %s\n", error.message);
        return;
    }
    const shares s = judge_derivatives(map, source, area(target) / area(source));
    printf("  %6.2f %6.2f %6.2f ", 100 * s.collapsed, 100 * s.inverted, 100 * s.failed);
    const icc_chart *charts[2] = {icc_map_source_chart(map), icc_map_target_chart(map)};
    for (int k = 0; k < 2; ++k) {
        icc_chart_measures m = {.size = sizeof m};
        bench_check(icc_chart_measure(charts[k], POINTS, &m, NULL, &error), &error);
        printf(" %7.2f %6.2f %6.2f %6.2f", 100 * m.unreachable, 100 * m.uncovered,
               100 * m.collapsed, 100 * m.not_inward);
    }
    printf("\n");
    fflush(stdout);
    icc_map_free(map);
}

static void measure_all(const char *name, const icc_domain *source, const icc_domain *target)
{
    for (int32_t function = ICC_FUNCTION_DECAY; function <= ICC_FUNCTION_DISTANCE; ++function)
        for (int32_t cells = 25; cells <= 200; cells *= 2)
            measure(name, source, target, function, cells);
}

static icc_domain *read_cage(const char *path)
{
    double *xy = bench_alloc(MOST_VERTICES, 2 * sizeof *xy);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    size_t n = 0;
    while (n < MOST_VERTICES && fscanf(file, "%lf %lf", &xy[2 * n], &xy[2 * n + 1]) == 2)
        ++n;
    fclose(file);
    icc_domain *domain = bench_domain(n, xy);
    free(xy);
    return domain;
}

int main(int argc, char **argv)
{
    printf("%%                        the map's derivative       the source's chart"
           "              the target's chart\n");
    printf("pair     function cells  collap invert failed  unreach uncov. collap notinw"
           " unreach uncov. collap notinw\n");
    for (int k = 0; k < BENCH_PAIRS && argc == 1; ++k) {
        const bench_pair pair = bench_number(k);
        icc_domain *source = bench_domain(pair.n, pair.source[0]);
        icc_domain *target = bench_domain(pair.n, pair.target[0]);
        measure_all(pair.name, source, target);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    for (int k = 1; k + 1 < argc; k += 2) {
        const char *slash = strrchr(argv[k], '/');
        icc_domain *source = read_cage(argv[k]), *target = read_cage(argv[k + 1]);
        measure_all(slash != NULL ? slash + 1 : argv[k], source, target);
        icc_domain_free(source);
        icc_domain_free(target);
    }
    return EXIT_SUCCESS;
}
