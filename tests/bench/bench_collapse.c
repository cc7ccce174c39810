/* How much the papers' method collapses. Without arguments: four pairs of shapes, each function and
 * resolution, what the charts miss, and the sign of the map's derivative at evenly spread points.
 * With a directory of cages (NAME.src.txt and NAME.tgt.txt, a vertex `x y` on a line): what the
 * charts of each cage miss, function by function. Cells along the longest side may follow; 50 if
 * not. */
#define _POSIX_C_SOURCE 200809L

#include "cages.h"

#include <dirent.h>
#include <stdbool.h>

enum { POINTS = 40000, MOST_CAGES = 200, N_MEASURES = 4 };

typedef struct kind {
    const char *name;
    int32_t function, constraints;
} kind;

static const kind KINDS[] = {{"decay", ICC_FUNCTION_DECAY, 0},
                             {"distance", ICC_FUNCTION_DISTANCE, 0},
                             {"laplace", ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_NONE},
                             {"lapl.tree", ICC_FUNCTION_LAPLACE, ICC_CONSTRAINTS_ALL},
                             {"bilaplace", ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_NONE},
                             {"bil.tree", ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_ALL},
                             {"clam.tree", ICC_FUNCTION_CLAMPED, ICC_CONSTRAINTS_ALL}};
enum { N_KINDS = sizeof KINDS / sizeof *KINDS };

static icc_chart_options options_of(const kind *k, int32_t cells)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = ICC_METHOD_GRADIENT,
                               .function = k->function,
                               .constraints = k->constraints,
                               .cells = cells};
}

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
                    const kind *k, int32_t cells)
{
    const icc_chart_options chart = options_of(k, cells);
    const icc_map_options options = {.size = sizeof options, .chart = &chart};
    icc_map *map;
    icc_error error = {.size = sizeof error};
    const icc_status status = icc_map_create(&map, source, target, &options, NULL, &error);
    if (status != ICC_OK) {
        printf("%-8.8s %-9s %5d  %s\n", name, k->name, (int)cells, error.message);
        return;
    }
    const shares s = judge_derivatives(map, source, area(target) / area(source));
    printf("%-8.8s %-9s %5d", name, k->name, (int)cells);
    printf(" %7.2f %6.2f %6.2f ", 100 * s.collapsed, 100 * s.inverted, 100 * s.failed);
    const icc_chart *charts[2] = {icc_map_source_chart(map), icc_map_target_chart(map)};
    for (int c = 0; c < 2; ++c) {
        icc_chart_report m = {.size = sizeof m};
        bench_check(icc_chart_get_report(charts[c], POINTS, &m, NULL, &error), &error);
        printf(" %7.2f %6.2f %6.2f %6.2f", 100 * m.unreachable, 100 * m.uncovered,
               100 * m.collapsed, 100 * m.not_inward);
    }
    printf("\n");
    fflush(stdout);
    icc_map_free(map);
}

static void measure_pairs(void)
{
    printf("%%                         the map's derivative       the source's chart"
           "              the target's chart\n");
    printf("pair     function  cells  collap invert failed  unreach uncov. collap notinw"
           " unreach uncov. collap notinw\n");
    for (int p = 0; p < BENCH_PAIRS; ++p) {
        const bench_pair pair = bench_number(p);
        icc_domain *source = bench_domain(pair.n, pair.source[0]);
        icc_domain *target = bench_domain(pair.n, pair.target[0]);
        for (int k = 0; k < N_KINDS; ++k)
            for (int32_t cells = 25; cells <= 200; cells *= 2)
                measure(pair.name, source, target, &KINDS[k], cells);
        icc_domain_free(source);
        icc_domain_free(target);
    }
}

/* ---- cages ---- */

typedef struct result {
    char name[32];
    double share[N_KINDS][N_MEASURES]; /* NaN where there is no chart */
    size_t critical[N_KINDS][3];       /* maxima, minima, saddles */
} result;

static bool measure_cage(const icc_domain *domain, int k, int32_t cells, result *r, double *seconds)
{
    const icc_chart_options options = options_of(&KINDS[k], cells);
    icc_error error = {.size = sizeof error};
    icc_chart *chart;
    const double start = bench_seconds();
    if (icc_chart_create(&chart, domain, &options, NULL, &error) != ICC_OK) {
        printf("%s: %s\n", KINDS[k].name, error.message);
        return false;
    }
    *seconds += bench_seconds() - start;
    icc_gradient_info info = {.size = sizeof info};
    icc_chart_report m = {.size = sizeof m};
    bench_check(icc_chart_get_gradient_info(chart, &info), &error);
    bench_check(icc_chart_get_report(chart, POINTS, &m, NULL, &error), &error);
    memcpy(r->critical[k], (size_t[]){info.n_maxima, info.n_minima, info.n_saddles},
           sizeof r->critical[k]);
    memcpy(r->share[k], (double[]){m.unreachable, m.uncovered, m.collapsed, m.not_inward},
           sizeof r->share[k]);
    icc_chart_free(chart);
    return true;
}

static int is_cage(const struct dirent *entry)
{
    const char *dot = strstr(entry->d_name, ".txt");
    return entry->d_name[0] != '.' && dot != NULL && dot[4] == '\0';
}

static void print_table(const char *title, int measured, const result *results, int n)
{
    printf("\n%-30s", title);
    for (int k = 0; k < N_KINDS; ++k)
        printf(" %9s", KINDS[k].name);
    double sum[N_KINDS] = {0};
    int n_summed = 0;
    for (int i = 0; i < n; ++i) {
        bool complete = true;
        printf("\n%-30s", results[i].name);
        for (int k = 0; k < N_KINDS; ++k) {
            printf(" %9.2f", 100 * results[i].share[k][measured]);
            complete = complete && !isnan(results[i].share[k][measured]);
        }
        for (int k = 0; k < N_KINDS && complete; ++k)
            sum[k] += results[i].share[k][measured];
        n_summed += complete;
    }
    printf("\n%-30s", "mean");
    for (int k = 0; k < N_KINDS; ++k)
        printf(" %9.2f", 100 * sum[k] / n_summed);
    printf("\n");
}

static void print_critical(const result *results, int n)
{
    printf("\n%-30s", "maxima/minima/saddles");
    int n_regular[N_KINDS] = {0};
    for (int i = 0; i < n; ++i) {
        printf("\n%-30s", results[i].name);
        for (int k = 0; k < N_KINDS; ++k) {
            const size_t *c = results[i].critical[k];
            char text[64];
            (void)snprintf(text, sizeof text, "%zu/%zu/%zu", c[0], c[1], c[2]);
            printf(" %9s", text);
            n_regular[k] += c[0] == 1 && c[1] == 0 && c[2] == 0;
        }
    }
    printf("\n%-30s", "one maximum, nothing else");
    for (int k = 0; k < N_KINDS; ++k)
        printf(" %9d", n_regular[k]);
    printf("\n");
}

static void measure_cages(const char *directory, int32_t cells)
{
    static const char *const TITLES[N_MEASURES] = {"% unreachable", "% uncovered", "% collapsed",
                                                   "% not inward"};
    static result results[MOST_CAGES];
    struct dirent **entries;
    double seconds[N_KINDS] = {0};
    int n = scandir(directory, &entries, is_cage, alphasort);
    if (n <= 0) {
        printf("%s: no cages; skipped\n", directory);
        return;
    }
    n = n < MOST_CAGES ? n : MOST_CAGES;
    for (int i = 0; i < n; ++i) {
        char path[4096];
        (void)snprintf(path, sizeof path, "%s/%s", directory, entries[i]->d_name);
        (void)snprintf(results[i].name, sizeof results[i].name, "%.31s", entries[i]->d_name);
        icc_domain *domain = cage_read(path);
        for (int k = 0; k < N_KINDS; ++k)
            if (!measure_cage(domain, k, cells, &results[i], &seconds[k]))
                for (int m = 0; m < N_MEASURES; ++m)
                    results[i].share[k][m] = NAN;
        icc_domain_free(domain);
    }
    for (int m = 0; m < N_MEASURES; ++m)
        print_table(TITLES[m], m, results, n);
    print_critical(results, n);
    printf("\n%-30s", "seconds, all together");
    for (int k = 0; k < N_KINDS; ++k)
        printf(" %9.3f", seconds[k]);
    printf("\n");
}

int main(int argc, char **argv)
{
    if (argc == 1)
        measure_pairs();
    else
        measure_cages(argv[1], argc > 2 ? (int32_t)atoi(argv[2]) : 50);
    return EXIT_SUCCESS;
}
