/* What default maps of the plane cost where charts give no start that can be repaired, beside a
 * limit: 15 times as long as kind curves of method disc, and half a second more. Arguments: cage
 * files, source and target by turns; `turned N` and a file: an outline onto itself, turned by N
 * vertices; `random N SEED`: so many random pairs. Without any, shapes of its own. With `-i N`
 * first, each map is improved N times more, which is the curve of energy against work. Processor
 * time, one thread. */
#include "map/map.h"
#include "map/plane/plane_kind.h"

#include "../random.h"
#include "../reports.h"
#include "cages.h"

enum { RUNS = 3 };
static const double FACTOR = 15, EXTRA = 0.5;

/* ---- shapes ---- */

static double *circle(size_t n)
{
    double *xy = bench_alloc(n, 2 * sizeof *xy);
    for (size_t k = 0; k < n; ++k)
        bench_polar(xy + 2 * k, 1, 360 * (double)k / (double)n);
    return xy;
}

static double *star(size_t n, double inner)
{
    double *xy = circle(n);
    for (size_t k = 0; k < n; k += 2) {
        xy[2 * k] *= inner;
        xy[2 * k + 1] *= inner;
    }
    return xy;
}

/* 4 teeth + 2 vertices. */
static double *comb(size_t teeth, double gap, double height)
{
    double *xy = bench_alloc(4 * teeth + 2, 2 * sizeof *xy), *p = xy + 4;
    xy[1] = xy[3] = -1;
    xy[2] = (double)teeth;
    for (size_t k = teeth; k-- > 0;)
        for (int j = 0; j < 4; ++j, p += 2) {
            p[0] = (double)k + 0.5 + (j < 2 ? 0.5 : -0.5) * gap;
            p[1] = j == 1 || j == 2 ? height : 0;
        }
    return xy;
}

/* 2 (turns per + 1) vertices. */
static double *spiral(size_t turns, size_t per, double width)
{
    const size_t n = turns * per + 1;
    double *xy = bench_alloc(2 * n, 2 * sizeof *xy);
    for (size_t k = 0; k < n; ++k) {
        const double share = (double)k / (double)per;
        bench_polar(xy + 2 * k, 1 + share + width, 360 * share);
        bench_polar(xy + 2 * (2 * n - 1 - k), 1 + share, 360 * share);
    }
    return xy;
}

/* A wiggly outline. */
static double *coast(size_t n, random_source *r)
{
    double *xy = circle(n), *radius = bench_alloc(n, sizeof *radius);
    for (size_t j = 2; j < n / 4 && j < 400; ++j) {
        const double phase = 6.28 * random_unit(r), size = pow((double)j, -1.1) / 6;
        for (size_t k = 0; k < n; ++k)
            radius[k] += size * cos(6.28318530717958647692 * (double)(j * k) / (double)n + phase);
    }
    for (size_t k = 0; k < 2 * n; ++k)
        xy[k] *= fmax(0.2, 1 + radius[k / 2]);
    free(radius);
    return xy;
}

static double *turned(size_t n, const double *from, size_t by)
{
    double *xy = bench_alloc(n, 2 * sizeof *xy);
    for (size_t k = 0; k < n; ++k)
        memcpy(xy + 2 * k, from + 2 * ((k + n - by % n) % n), 2 * sizeof *xy);
    return xy;
}

/* ---- measuring ---- */

static icc_map *create(const icc_domain *source, const icc_domain *target, int32_t kind,
                       double *seconds)
{
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_DISC};
    const icc_map_options options = {
        .size = sizeof options, .kind = kind, .chart = kind == ICC_MAP_CURVES ? &chart : NULL};
    const icc_env env = {.size = sizeof env, .threads = 1};
    icc_error error = {.size = sizeof error};
    icc_map *map;
    const double begin = bench_processor_seconds();
    bench_check(icc_map_create(&map, source, target, &options, &env, &error), &error);
    *seconds = bench_processor_seconds() - begin;
    return map;
}

static double limit_of(const icc_domain *source, const icc_domain *target)
{
    double least = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        double seconds;
        icc_map_free(create(source, target, ICC_MAP_CURVES, &seconds));
        least = fmin(least, seconds);
    }
    return FACTOR * least + EXTRA;
}

static void improve_on(icc_map *map, double seconds, int n)
{
    for (int k = 0; k < n && map != NULL; ++k) {
        icc_map *better;
        icc_improve_report report = {.size = sizeof report};
        icc_error error = {.size = sizeof error};
        const double begin = bench_processor_seconds();
        bench_check(icc_map_improve(&better, map, NULL, &report, NULL, &error), &error);
        seconds += bench_processor_seconds() - begin;
        printf("    %8.3f s in all %8zu %5zu %10.3g %10.6g\n", seconds, report.n_simplices,
               report.n_iterations, iccp_plane_of(better)->work, report.energy);
        icc_map_free(map);
        map = better;
    }
    icc_map_free(map);
}

static void measure(const char *name, size_t n, const double *before, const double *after,
                    int n_more)
{
    icc_domain *source = bench_domain(n, before), *target = bench_domain(n, after);
    icc_map_info info = {.size = sizeof info};
    const double limit = limit_of(source, target);
    double seconds;
    icc_map *map = create(source, target, 0, &seconds);
    (void)icc_map_get_info(map, &info);
    const bool is_mesh = info.kind == ICC_MAP_MESH;
    printf("%-16.16s %5zu %8.3f %8.3f %6.2f %8zu %5zu %10.3g %10.6g  %s%s\n", name, n, limit,
           seconds, seconds / limit, info.n_simplices, report_of(map).n_iterations,
           is_mesh ? iccp_plane_of(map)->work : 0, info.energy, is_mesh ? "mesh" : "curves",
           info.certified ? ", certified" : "");
    if (is_mesh)
        improve_on(map, seconds, n_more);
    else
        icc_map_free(map);
    fflush(stdout);
    icc_domain_free(source);
    icc_domain_free(target);
}

static void measure_own(int n_more)
{
    random_source r = {1};
    const struct {
        const char *name;
        size_t n;
        double *source, *target;
    } cases[] = {
        {"star 64", 64, star(64, 0.05), turned(64, star(64, 0.05), 1)},
        {"star 100", 100, star(100, 0.05), turned(100, star(100, 0.05), 1)},
        {"comb 150", 602, circle(602), comb(150, 0.5, 5)},
        {"comb 200", 802, circle(802), comb(200, 0.5, 5)},
        {"spiral 20", 962, spiral(20, 24, 0.4), circle(962)},
        {"spiral 50", 2402, spiral(50, 24, 0.4), circle(2402)},
        {"spiral 80", 2562, spiral(80, 16, 0.4), circle(2562)},
        {"spiral 100", 4802, spiral(100, 24, 0.4), circle(4802)},
        {"spiral 200", 9602, spiral(200, 24, 0.4), circle(9602)},
        {"spiral 300", 14402, spiral(300, 24, 0.4), circle(14402)},
        {"spiral to coast", 9602, spiral(200, 24, 0.4), coast(9602, &r)},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
        measure(cases[k].name, cases[k].n, cases[k].source, cases[k].target, n_more);
}

/* A comb or a spiral to a coast, a coast turned onto itself, or a star by one vertex. */
static void measure_random_pair(int k, uint64_t seed, int n_more)
{
    static const char *const names[] = {"comb", "spiral", "coast", "star"};
    random_source r = {seed};
    const int kind = k % 4;
    const size_t teeth = 5 + (size_t)random_below(&r, 100);
    const size_t turns = 2 + (size_t)random_below(&r, 30), per = 8 + (size_t)random_below(&r, 24);
    const double width = random_between(&r, 0.1, 0.9);
    const size_t n = kind == 0   ? 4 * teeth + 2
                     : kind == 1 ? 2 * (turns * per + 1)
                                 : 30 + 2 * (size_t)random_below(&r, 300);
    double *source = kind == 0   ? comb(teeth, width, random_between(&r, 0.5, 10))
                     : kind == 1 ? spiral(turns, per, width)
                     : kind == 2 ? coast(n, &r)
                                 : star(n, width / 3);
    const size_t by = kind == 3 ? 1 : 1 + (size_t)random_below(&r, (int)n / 5);
    double *target = kind < 2 ? coast(n, &r) : turned(n, source, by);
    char name[32];
    (void)snprintf(name, sizeof name, "%s %d", names[kind], k);
    measure(name, n, source, target, n_more);
    free(source);
    free(target);
}

/* ---- files ---- */

static double *read(const char *path, size_t *n)
{
    double *xy = bench_alloc(CAGE_MOST, 2 * sizeof *xy);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    for (*n = 0; *n < CAGE_MOST && fscanf(file, "%lf %lf", &xy[2 * *n], &xy[2 * *n + 1]) == 2;)
        ++*n;
    fclose(file);
    return xy;
}

int main(int argc, char **argv)
{
    int n_more = 0;
    if (argc > 2 && strcmp(argv[1], "-i") == 0) {
        n_more = atoi(argv[2]);
        argc -= 2;
        argv += 2;
    }
    printf(
        "case                 n  limit,s    CPU,s  ratio triangles steps       work     energy\n");
    if (argc < 2)
        measure_own(n_more);
    if (argc > 3 && strcmp(argv[1], "random") == 0) {
        for (int k = 0; k < atoi(argv[2]); ++k)
            measure_random_pair(k, strtoull(argv[3], NULL, 10) + (unsigned)k, n_more);
        return EXIT_SUCCESS;
    }
    for (int k = 1; k + 1 < argc; k += 2) {
        size_t n, n_target;
        const bool is_turned = strcmp(argv[k], "turned") == 0 && k + 2 < argc;
        double *source = read(argv[is_turned ? k + 2 : k], &n);
        double *target =
            is_turned ? turned(n, source, (size_t)atoi(argv[k + 1])) : read(argv[k + 1], &n_target);
        measure(cage_name(argv[is_turned ? k + 2 : k]), n, source, target, n_more);
        k += is_turned;
        free(source);
        free(target);
    }
    return EXIT_SUCCESS;
}
