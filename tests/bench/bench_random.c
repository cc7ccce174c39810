/* Whether foliation and disc charts of random simple polygons are made and certified, alone and in
 * pairs, and default maps of pairs; and how far points come back. What is not made or not certified
 * is counted as failed; of runs over parts of the seeds the numbers add up. Times are the
 * processor's.
 * usage: bench_random [NUMBER [FIRST_SEED [CELLS [ITERATIONS]]]] [-v], cells of charts, 0: 50, 20 of
 * default maps, and steps of default maps a level, by default 1; -v prints the polygon of each
 * failure. A small budget is 12 -1. */

#include "random_polygons.h"

#include "cages.h"

enum { POINTS = 200, PAIR_EVERY = 10, N_METHODS = 2 };

static const int32_t METHODS[N_METHODS] = {ICC_METHOD_FOLIATION, ICC_METHOD_DISC};
static const char *const METHOD_NAMES[N_METHODS] = {"foliation", "disc"};

typedef struct tally {
    size_t n, n_failed; /* charts or pairs */
    size_t n_points, n_lost, n_off;
    size_t n_refined, n_less_harmonic, n_ties;
    double worst, seconds, slowest;
} tally;

/* Of the diagonal: points that come back worse are counted. */
static const double FAR_OFF = 1e-9;

static int verbose;
static int32_t cells, iterations = 1;

static void print_polygon(const polygon *p)
{
    for (size_t k = 0; k < p->n && verbose; ++k)
        printf("    %.17g %.17g\n", p->xy[k][0], p->xy[k][1]);
}

static void report_failure(const char *what, int kind, uint64_t seed, const polygon *p,
                           const icc_error *error)
{
    printf("  FAILED %s %s seed %llu n %zu: side %d: %s\n", what, polygon_kind_name(kind),
           (unsigned long long)seed, p->n, (int)error->side, error->message);
    print_polygon(p);
}

static void note_info(tally *t, const icc_chart *chart)
{
    icc_chart_info info = {.size = sizeof info};
    icc_foliation_info own = {.size = sizeof own};
    (void)icc_chart_get_info(chart, &info);
    t->n_failed += !info.certified;
    t->n_refined += info.cells != (cells > 0 ? cells : 50);
    t->n_less_harmonic +=
        icc_chart_get_foliation_info(chart, &own) == ICC_OK && own.harmonic_share < 0.5;
    t->n_ties += own.n_ties > 0;
}

static void note_time(tally *t, double start)
{
    const double seconds = bench_processor_seconds() - start;
    t->seconds += seconds;
    t->slowest = fmax(t->slowest, seconds);
    ++t->n;
}

static void try_chart(tally *t, int method, int kind, uint64_t seed, const polygon *p,
                      const icc_domain *domain)
{
    const icc_chart_options options = {
        .size = sizeof options, .method = METHODS[method], .cells = cells};
    icc_chart *chart;
    icc_error error = {.size = sizeof error};
    const double start = bench_processor_seconds();
    const icc_status status = icc_chart_create(&chart, domain, &options, NULL, &error);
    note_time(t, start);
    if (status != ICC_OK) {
        ++t->n_failed;
        report_failure(METHOD_NAMES[method], kind, seed, p, &error);
        return;
    }
    note_info(t, chart);
    icc_chart_free(chart);
}

/* Sends points there and back. */
static void try_points(tally *t, uint64_t seed, const icc_map *map, const icc_domain *source)
{
    double points[2 * POINTS], images[2 * POINTS];
    icc_error error = {.size = sizeof error};
    const size_t n = cage_points(source, POINTS, points);
    size_t lost[2];
    bench_check(icc_map_apply(map, n, points, images, NULL, &lost[0], NULL), &error);
    bench_check(icc_map_apply_inverse(map, n, images, images, NULL, &lost[1], NULL), &error);
    const double diagonal = cage_diagonal(source);
    double worst = 0;
    for (size_t i = 0; i < n; ++i) {
        const double off =
            hypot(images[2 * i] - points[2 * i], images[2 * i + 1] - points[2 * i + 1]);
        worst = fmax(worst, off / diagonal);
        t->n_off += off > FAR_OFF * diagonal;
    }
    t->n_points += n;
    t->n_lost += lost[1];
    if ((lost[1] > 0 || worst > FAR_OFF) && verbose)
        printf("  round trip %.1e, %zu and %zu of %zu points lost, seed %llu\n", worst, lost[0],
               lost[1], n, (unsigned long long)seed);
    t->worst = fmax(t->worst, worst);
}

static void try_pair(tally *t, int method, const int kinds[2], uint64_t seed, const polygon *p,
                     icc_domain *const domains[2])
{
    const icc_chart_options chart = {
        .size = sizeof chart, .method = METHODS[method], .cells = cells};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    icc_map *map;
    icc_error error = {.size = sizeof error};
    const double start = bench_processor_seconds();
    const icc_status status = icc_map_create(&map, domains[0], domains[1], &options, NULL, &error);
    note_time(t, start);
    if (status != ICC_OK) {
        ++t->n_failed;
        report_failure("pair", kinds[0], seed, p, &error);
        return;
    }
    note_info(t, icc_map_source_chart(map));
    try_points(t, seed, map, domains[0]);
    icc_map_free(map);
}

/* A default map, which has to be a mesh, and certified. */
static void try_default(tally *t, const int kinds[2], uint64_t seed, const polygon *p,
                        icc_domain *const domains[2])
{
    const icc_chart_options chart = {.size = sizeof chart, .cells = cells};
    const icc_map_options options = {
        .size = sizeof options, .iterations = iterations, .chart = &chart};
    icc_map_info info = {.size = sizeof info};
    icc_map *map;
    icc_error error = {.size = sizeof error};
    const double start = bench_processor_seconds();
    const icc_status status = icc_map_create(&map, domains[0], domains[1], &options, NULL, &error);
    note_time(t, start);
    if (status == ICC_OK)
        (void)icc_map_get_info(map, &info);
    if (status != ICC_OK || info.kind != ICC_MAP_MESH || info.certified != 1) {
        ++t->n_failed;
        report_failure("default map", kinds[0], seed, p, &error);
    } else
        try_points(t, seed, map, domains[0]);
    icc_map_free(map);
}

static void print_tally(const char *name, const tally *t)
{
    printf("%-20s %6zu %6zu %6zu %6zu %6zu  %6.2f %7.1f", name, t->n, t->n_failed, t->n_refined,
           t->n_less_harmonic, t->n_ties, 1e3 * t->seconds / (double)t->n, 1e3 * t->slowest);
    if (t->n_points > 0)
        printf("  %8.1e %6zu %8.4f", t->worst, t->n_lost,
               100 * (double)t->n_off / (double)t->n_points);
    printf("\n");
}

typedef struct tallies {
    tally charts[POLYGON_KINDS][N_METHODS], pairs[N_METHODS], defaults;
    size_t n_not_drawn;
} tallies;

static void try_seed(tallies *all, uint64_t seed)
{
    random_source r = {seed};
    const int kinds[2] = {(int)(seed % POLYGON_KINDS), random_below(&r, POLYGON_KINDS)};
    const bool paired = seed / POLYGON_KINDS % PAIR_EVERY == 0;
    const size_t n = 5 + (size_t)random_below(&r, POLYGON_MOST - 4);
    polygon p[2];
    icc_domain *domains[2] = {NULL, NULL};
    domains[0] = polygon_domain(&p[0], kinds[0], n, paired ? n : 0, 2, &r);
    if (paired)
        domains[1] = polygon_domain(&p[1], kinds[1], n, n, 2, &r);
    for (int method = 0; method < N_METHODS; ++method) {
        if (domains[0] != NULL)
            try_chart(&all->charts[kinds[0]][method], method, kinds[0], seed, &p[0], domains[0]);
        if (domains[0] != NULL && domains[1] != NULL)
            try_pair(&all->pairs[method], method, kinds, seed, &p[0], domains);
    }
    if (domains[0] != NULL && domains[1] != NULL)
        try_default(&all->defaults, kinds, seed, &p[0], domains);
    all->n_not_drawn += domains[0] == NULL;
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
}

int main(int argc, char **argv)
{
    static tallies all;
    verbose = argc > 1 && strcmp(argv[argc - 1], "-v") == 0;
    argc -= verbose;
    const uint64_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 20000;
    const uint64_t first = argc > 2 ? strtoull(argv[2], NULL, 10) : 0;
    cells = argc > 3 ? (int32_t)strtol(argv[3], NULL, 10) : 0;
    iterations = argc > 4 ? (int32_t)strtol(argv[4], NULL, 10) : 1;
    for (uint64_t seed = first; seed < first + n; ++seed)
        try_seed(&all, seed);
    printf("%llu polygons, %zu of them could not be drawn\n", (unsigned long long)n,
           all.n_not_drawn);
    printf("                         number failed  finer uniform  ties  mean ms max ms   worst"
           "       lost  points off\n                                        cells   flux"
           "                         round trip points > 1e-9, %%\n");
    for (int method = 0; method < N_METHODS; ++method)
        for (int kind = 0; kind < POLYGON_KINDS; ++kind) {
            char name[32];
            snprintf(name, sizeof name, "%s %s", METHOD_NAMES[method], polygon_kind_name(kind));
            if (all.charts[kind][method].n > 0)
                print_tally(name, &all.charts[kind][method]);
        }
    print_tally("foliation pairs", &all.pairs[0]);
    print_tally("disc pairs", &all.pairs[1]);
    print_tally("default maps", &all.defaults);
    size_t n_failed = all.pairs[0].n_failed + all.pairs[1].n_failed + all.defaults.n_failed;
    size_t n_lost = all.pairs[0].n_lost + all.pairs[1].n_lost + all.defaults.n_lost;
    for (int kind = 0; kind < POLYGON_KINDS; ++kind)
        n_failed += all.charts[kind][0].n_failed + all.charts[kind][1].n_failed;
    printf("seeds %llu to %llu: %zu failed, %zu points lost\n", (unsigned long long)first,
           (unsigned long long)(first + n - 1), n_failed, n_lost);
    return n_failed + n_lost > 0 ? EXIT_FAILURE : EXIT_SUCCESS;
}
