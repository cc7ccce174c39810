/* What mesh maps cost and how fair they are. Arguments: cage files, source and target by turns. Or
 * `random`, then how many pairs of random polygons to map, the first seed, the iterations (0: as
 * many as pay, -1: none), and -v to print the polygons of each pair that got no mesh map. One
 * thread. */
#include "../reports.h"
#include "random_polygons.h"

#include "cages.h"

enum { RUNS = 5, POINTS = 100000, MOST_PAIRS = 64 };

/* Maps that take longer than this, in seconds, are made three times only. */
static const double LONG = 0.3;

/* The energies that a study of these shapes ended with, on meshes of its own. */
static const double REFERENCE[20] = {4.87, 4.07, 5.07, 9.75, 30.7,  71.2, 18.6, 4.69, 6.04, 5.00,
                                     7.01, 4.40, 4.43, 5.65, 4.053, 9.09, 48.5, 10.1, 5.52, 9.03};

/* For cages called d01 to d20. */
static double reference_of(const char *name)
{
    const int k = name[0] == 'd' ? atoi(name + 1) : 0;
    return k >= 1 && k <= 20 ? REFERENCE[k - 1] : NAN;
}

static icc_map *create(const icc_domain *source, const icc_domain *target, int32_t iterations,
                       icc_error *error)
{
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_MESH, .iterations = iterations};
    icc_map *map;
    (void)icc_map_create(&map, source, target, &options, NULL, error);
    return map;
}

/* The least time of several runs; the last map is kept. */
static icc_map *time_creation(const icc_domain *source, const icc_domain *target,
                              int32_t iterations, double *least)
{
    icc_map *map = NULL;
    icc_error error = {.size = sizeof error};
    *least = HUGE_VAL;
    for (int k = 0; k < RUNS && (k < 3 || *least < LONG); ++k) {
        icc_map_free(map);
        const double start = bench_seconds();
        map = create(source, target, iterations, &error);
        *least = fmin(*least, bench_seconds() - start);
        if (map == NULL) {
            printf("  %s\n", error.message);
            break;
        }
    }
    return map;
}

typedef icc_status (*apply)(const icc_map *map, size_t n, const double *points, double *images,
                            icc_status *status, size_t *n_failed, const icc_env *env);

/* Seconds a point, the least of several runs through 500 points at a time. */
static double time_points(const icc_map *map, apply function, size_t n, const double *points,
                          double *images)
{
    const size_t portion = 500;
    double sum = 0;
    size_t done = 0;
    for (; done + portion <= n; done += portion) {
        double least = HUGE_VAL;
        for (int k = 0; k < 3; ++k) {
            const double start = bench_seconds();
            (void)function(map, portion, points + 2 * done, images + 2 * done, NULL, NULL, NULL);
            least = fmin(least, bench_seconds() - start);
        }
        sum += least;
    }
    return sum / (double)done;
}

static void print_points(const icc_map *map, const icc_domain *source)
{
    double *points = bench_alloc(POINTS, 2 * sizeof *points);
    double *images = bench_alloc(POINTS, 2 * sizeof *images);
    double *back = bench_alloc(POINTS, 2 * sizeof *back);
    const size_t n = cage_points(source, POINTS, points);
    size_t lost[2];
    const double there_seconds = time_points(map, icc_map_apply, n, points, images);
    (void)icc_map_apply(map, n, points, images, NULL, &lost[0], NULL);
    const double back_seconds = time_points(map, icc_map_apply_inverse, n, images, back);
    (void)icc_map_apply_inverse(map, n, images, back, NULL, &lost[1], NULL);
    double worst = 0;
    for (size_t i = 0; i < n; ++i)
        worst =
            fmax(worst, hypot(back[2 * i] - points[2 * i], back[2 * i + 1] - points[2 * i + 1]));
    printf("  %6.3f %6.3f  %7.1e %4zu\n", 1e6 * there_seconds, 1e6 * back_seconds,
           worst / cage_diagonal(source), lost[0] + lost[1]);
    fflush(stdout);
    free(points);
    free(images);
    free(back);
}

static void print_map(const icc_map_info *info, const icc_map_report *made, const char *name)
{
    const double reference = reference_of(name);
    printf(" %6zu %5zu %5zu  %9.4g %8.4g %6.4g %+6.1f  %3zu %2d", info->n_simplices,
           made->n_inverted, made->n_unrepaired, made->energy_start, info->energy, reference,
           100 * (info->energy / reference - 1), made->n_iterations, (int)made->n_levels);
}

/* Fills in the seconds with and without improvement. */
static void measure(const char *name, const icc_domain *source, const icc_domain *target,
                    double seconds[2])
{
    icc_map_info info = {.size = sizeof info};
    printf("%-8.8s %6zu", name, cage_info(source).n_vertices);
    icc_map *map = time_creation(source, target, -1, &seconds[1]);
    icc_map_free(map);
    map = time_creation(source, target, 0, &seconds[0]);
    if (map == NULL)
        return;
    (void)icc_map_get_info(map, &info);
    const icc_map_report made = report_of(map);
    print_map(&info, &made, name);
    printf("  %7.1f %6.1f (%5.1f %6.1f %5.1f)", 1e3 * seconds[0], 1e3 * seconds[1],
           1e3 * made.seconds_repair, 1e3 * made.seconds_improve, 1e3 * made.seconds_certify);
    print_points(map, source);
    icc_map_free(map);
}

static void measure_files(int n_files, char **files)
{
    double with[MOST_PAIRS], without[MOST_PAIRS], sum[2] = {0, 0};
    size_t n = 0;
    printf("                     triangles       |J|^2 + |J^-1|^2, target at equal area"
           "          build, ms                            us a point     round points\n"
           "pair          n    all invert left     start      end   ref.  ref,%%   it lv"
           "      all  plain (repair improve check)  there   back   trip  lost\n");
    for (int k = 0; k + 1 < n_files && n < MOST_PAIRS; k += 2) {
        double seconds[2] = {0, 0};
        icc_domain *source = cage_read(files[k]), *target = cage_read(files[k + 1]);
        measure(cage_name(files[k]), source, target, seconds);
        with[n] = seconds[0];
        without[n++] = seconds[1];
        sum[0] += seconds[0];
        sum[1] += seconds[1];
        icc_domain_free(source);
        icc_domain_free(target);
    }
    printf("build: median %.1f ms, sum %.2f s; without improvement: median %.1f ms, sum %.2f s\n",
           1e3 * cage_quantile(with, n, 0.5), sum[0], 1e3 * cage_quantile(without, n, 0.5), sum[1]);
}

typedef struct tally {
    size_t n, n_error, n_curves, n_uncertified, n_inverted;
    double seconds, slowest, energy;
} tally;

static void note(tally *t, const icc_map *map, double seconds, icc_map_info *info)
{
    ++t->n;
    t->seconds += seconds;
    t->slowest = fmax(t->slowest, seconds);
    t->n_error += map == NULL;
    if (map == NULL)
        return;
    (void)icc_map_get_info(map, info);
    t->n_curves += info->kind != ICC_MAP_MESH;
    t->n_uncertified += !info->certified;
    t->n_inverted += report_of(map).n_inverted > 0;
    t->energy += log(info->energy > 0 ? info->energy : 1);
}

static void print_polygons(const polygon p[2])
{
    for (size_t k = 0; k < p[0].n; ++k)
        printf("    %.17g %.17g  %.17g %.17g\n", p[0].xy[k][0], p[0].xy[k][1], p[1].xy[k][0],
               p[1].xy[k][1]);
}

/* Both polygons are drawn with as few as a third of their vertices; the rest are put on their edges
 * as unevenly as 1 : 1000, so that corresponding edges differ as much in length. */
static void try_pair(tally t[POLYGON_KINDS], uint64_t seed, int32_t iterations, int verbose)
{
    random_source r = {seed};
    const int kinds[2] = {(int)(seed % POLYGON_KINDS), random_below(&r, POLYGON_KINDS)};
    const size_t n = 5 + (size_t)random_below(&r, POLYGON_MOST - 4);
    const double unevenness = polygon_scale(&r, 1, 1000);
    polygon p[2];
    icc_domain *domains[2];
    for (int k = 0; k < 2; ++k) {
        const size_t least = n / 3 > 5 ? n / 3 : 5;
        const size_t corners = least + (size_t)random_below(&r, (int)(n - least) + 1);
        domains[k] = polygon_domain(&p[k], kinds[k], corners, n, unevenness, &r);
    }
    if (domains[0] != NULL && domains[1] != NULL) {
        icc_error error = {.size = sizeof error};
        icc_map_info info = {.size = sizeof info};
        const double start = bench_seconds();
        icc_map *map = create(domains[0], domains[1], iterations, &error);
        note(&t[kinds[0]], map, bench_seconds() - start, &info);
        if (map == NULL || info.kind != ICC_MAP_MESH || !info.certified) {
            printf("  %s to %s, seed %llu, n %zu, uneven 1:%.0f: ", polygon_kind_name(kinds[0]),
                   polygon_kind_name(kinds[1]), (unsigned long long)seed, n, unevenness);
            if (map == NULL)
                printf("%s\n", error.message);
            else
                printf("kind %d, %zu of %zu triangles inverted, %zu left, %.0f ms\n",
                       (int)info.kind, report_of(map).n_inverted, info.n_simplices,
                       report_of(map).n_unrepaired, 1e3 * report_of(map).seconds);
            fflush(stdout);
            if (verbose)
                print_polygons(p);
        }
        icc_map_free(map);
    }
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
}

static void measure_random(uint64_t n, uint64_t first, int32_t iterations, int verbose)
{
    tally t[POLYGON_KINDS] = {{0}};
    for (uint64_t seed = first; seed < first + n; ++seed)
        try_pair(t, seed, iterations, verbose);
    printf("source     pairs  repaired  curves  errors  uncertified  mean ms   max ms  energy"
           " (geometric mean)\n");
    for (int kind = 0; kind < POLYGON_KINDS; ++kind)
        printf("%-9s %6zu    %6zu  %6zu  %6zu       %6zu  %7.1f %8.1f  %6.4g\n",
               polygon_kind_name(kind), t[kind].n, t[kind].n_inverted, t[kind].n_curves,
               t[kind].n_error, t[kind].n_uncertified, 1e3 * t[kind].seconds / (double)t[kind].n,
               1e3 * t[kind].slowest, exp(t[kind].energy / (double)t[kind].n));
}

int main(int argc, char **argv)
{
    const int verbose = argc > 2 && strcmp(argv[argc - 1], "-v") == 0;
    argc -= verbose;
    if (argc < 2 || strcmp(argv[1], "random") != 0) {
        measure_files(argc - 1, argv + 1);
        return EXIT_SUCCESS;
    }
    const uint64_t n = argc > 2 ? strtoull(argv[2], NULL, 10) : 2000;
    const uint64_t first = argc > 3 ? strtoull(argv[3], NULL, 10) : 0;
    const int32_t iterations = argc > 4 ? (int32_t)atoi(argv[4]) : 0;
    measure_random(n, first, iterations, verbose);
    return EXIT_SUCCESS;
}
