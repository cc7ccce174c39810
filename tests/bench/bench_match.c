/* Outlines that do not correspond: usage: bench_match [map] [drop D] SEED ... < FILES, pairs of
 * lines SOURCE and TARGET. The vertices of each pair correspond; 30 % more are put at random places
 * on edges and the starts turned, for each side apart, and icc_match_create() has to find the pairs
 * again. Error: distance to the true partner, in % of the target's perimeter, mean along the
 * source's. `map`: also what it costs to map what was found, by what it costs to map the files as
 * they are, the least of three by turns, with the triangles that were to be repaired and the
 * energies of both. `drop`: the option of that name. */
#include "../reports.h"
#include "bench.h"

#include <stdbool.h>

enum { MOST = 100000, PLACES = 2000, RUNS = 3 };

static uint64_t state;

static double uniform(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) / 9007199254740992.0;
}

typedef struct ring {
    size_t n;
    double *xy, *label; /* label: the vertex of the file, and how far from it to the next */
} ring;

static ring ring_read(const char *path)
{
    ring r = {.xy = bench_alloc(MOST, 2 * sizeof(double))};
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    while (r.n < MOST && fscanf(file, "%lf %lf", &r.xy[2 * r.n], &r.xy[2 * r.n + 1]) == 2)
        ++r.n;
    fclose(file);
    return r;
}

static int compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static ring disguise(const ring *r)
{
    const size_t extra = r->n * 3 / 10 + 3;
    ring d = {.n = r->n + extra};
    double *labels = bench_alloc(d.n, sizeof(double));
    for (size_t k = 0; k < d.n; ++k)
        labels[k] = k < r->n ? (double)k : uniform() * (double)r->n;
    qsort(labels, d.n, sizeof *labels, compare);
    d.xy = bench_alloc(d.n, 2 * sizeof(double));
    d.label = bench_alloc(d.n, sizeof(double));
    const size_t first = (size_t)(uniform() * (double)d.n) % d.n;
    for (size_t k = 0; k < d.n; ++k) {
        d.label[k] = labels[(first + k) % d.n];
        const size_t i = (size_t)d.label[k];
        const double f = d.label[k] - (double)i;
        for (int e = 0; e < 2; ++e)
            d.xy[2 * k + (size_t)e] =
                (1 - f) * r->xy[2 * i + (size_t)e] + f * r->xy[2 * ((i + 1) % r->n) + (size_t)e];
    }
    free(labels);
    return d;
}

static double *lengths(const ring *r)
{
    double *s = bench_alloc(r->n + 1, sizeof *s);
    for (size_t k = 0; k < r->n; ++k) {
        const double *p = r->xy + 2 * k, *q = r->xy + 2 * ((k + 1) % r->n);
        s[k + 1] = s[k] + hypot(q[0] - p[0], q[1] - p[1]);
    }
    return s;
}

/* The vertex of the file that a vertex of the result is or lies behind: labels of the vertices that
 * were given, and between them by arc length. */
static void labels_of(double *label, size_t n, const double *xy, const uint32_t *origin,
                      const ring *given, size_t n_file)
{
    size_t first = 0;
    while (origin[first] == UINT32_MAX)
        ++first;
    for (size_t at = 0; at < n;) {
        const size_t k = (first + at) % n;
        size_t run = 1;
        double length = 0;
        double to[PLACES];
        for (;; ++run) {
            const double *p = xy + 2 * ((k + run - 1) % n), *q = xy + 2 * ((k + run) % n);
            length += hypot(q[0] - p[0], q[1] - p[1]);
            if (run < PLACES)
                to[run] = length;
            if (origin[(k + run) % n] != UINT32_MAX)
                break;
        }
        const double a = given->label[origin[k]], b = given->label[origin[(k + run) % n]];
        const double width = b > a ? b - a : b + (double)n_file - a;
        label[k] = a;
        for (size_t m = 1; m < run && m < PLACES; ++m)
            label[(k + m) % n] = fmod(a + width * to[m] / length, (double)n_file);
        at += run;
    }
}

static double length_at(const double *s, size_t n, double label)
{
    const size_t k = (size_t)label % n;
    return s[k] + (label - floor(label)) * (s[k + 1] - s[k]);
}

static double error_of(const icc_match *match, const ring *files, const ring *given)
{
    icc_match_info info = {.size = sizeof info};
    (void)icc_match_get_info(match, &info);
    const size_t n = info.n_vertices;
    const icc_domain *domains[2] = {icc_match_source(match), icc_match_target(match)};
    uint32_t *origin[2];
    double *label[2], *s[2];
    for (int e = 0; e < 2; ++e) {
        origin[e] = bench_alloc(n, sizeof(uint32_t));
        label[e] = bench_alloc(n, sizeof(double));
        s[e] = lengths(&files[e]);
    }
    (void)icc_match_get_origins(match, origin[0], origin[1]);
    for (int e = 0; e < 2; ++e) {
        double *xy = bench_alloc(n, 2 * sizeof(double));
        (void)icc_domain_get_boundary(domains[e], xy, NULL);
        labels_of(label[e], n, xy, origin[e], &given[e], files[e].n);
        free(xy);
    }
    double sum = 0, weight = 0;
    for (size_t k = 0; k < n; ++k) {
        const double from = length_at(s[0], files[0].n, label[0][k]);
        double to = length_at(s[0], files[0].n, label[0][(k + 1) % n]);
        to += to < from ? s[0][files[0].n] : 0;
        const double truth = length_at(s[1], files[1].n, label[0][k]);
        const double is = length_at(s[1], files[1].n, label[1][k]);
        double d = fabs(truth - is) / s[1][files[1].n];
        d = d < 1 - d ? d : 1 - d;
        sum += d * (to - from);
        weight += to - from;
    }
    for (int e = 0; e < 2; ++e) {
        free(origin[e]);
        free(label[e]);
        free(s[e]);
    }
    return sum / weight;
}

/* Maps two domains: the processor's seconds. */
static double map_of(icc_map_info *info, icc_map_report *report, const icc_domain *source,
                     const icc_domain *target)
{
    icc_map *map = NULL;
    icc_error error = {.size = sizeof error};
    const double begin = bench_processor_seconds();
    bench_check(icc_map_create(&map, source, target, NULL, NULL, &error), &error);
    const double seconds = bench_processor_seconds() - begin;
    (void)icc_map_get_info(map, info);
    *report = report_of(map);
    icc_map_free(map);
    return seconds;
}

static void compare_maps(const icc_match *match, const ring *files)
{
    icc_map_info found = {.size = sizeof found}, truth = {.size = sizeof truth};
    icc_map_report made[2];
    icc_domain *const source = bench_domain(files[0].n, files[0].xy);
    icc_domain *const target = bench_domain(files[1].n, files[1].xy);
    double cost = HUGE_VAL, least = HUGE_VAL;
    for (int k = 0; k < RUNS; ++k) {
        const double a = map_of(&found, &made[0], icc_match_source(match), icc_match_target(match));
        const double b = map_of(&truth, &made[1], source, target);
        cost = a < cost ? a : cost;
        least = b < least ? b : least;
    }
    printf("%34s map %.2f s by %.3f s = %.2f, repaired %zu by %zu, energy %.2f by %.2f\n", "", cost,
           least, cost / least, made[0].n_inverted, made[1].n_inverted, found.energy, truth.energy);
    icc_domain_free(source);
    icc_domain_free(target);
}

int main(int argc, char **argv)
{
    const char *slash;
    icc_match_options options = {.size = sizeof options, .least_sure = 1};
    const bool maps = argc > 1 && strcmp(argv[1], "map") == 0;
    const int next = maps ? 2 : 1;
    const bool drops = next + 1 < argc && strcmp(argv[next], "drop") == 0;
    const int first = drops ? next + 2 : next;
    char paths[2][1024];
    if (drops)
        options.drop = strtod(argv[next + 1], NULL);
    while (scanf("%1023s %1023s", paths[0], paths[1]) == 2) {
        ring files[2] = {ring_read(paths[0]), ring_read(paths[1])};
        slash = strrchr(paths[0], '/');
        for (int k = first; k < argc; ++k) {
            state = strtoull(argv[k], NULL, 10) * 2654435761u + 1;
            ring given[2] = {disguise(&files[0]), disguise(&files[1])};
            icc_domain *domain[2];
            for (int e = 0; e < 2; ++e)
                domain[e] = bench_domain(given[e].n, given[e].xy);
            icc_match *match = NULL;
            icc_error error = {.size = sizeof error};
            const double begin = bench_processor_seconds();
            const icc_status status =
                icc_match_create(&match, domain[0], domain[1], 0, NULL, &options, NULL, &error);
            const double seconds = bench_processor_seconds() - begin;
            printf("%-28s", slash != NULL ? slash + 1 : paths[0]);
            if (status != ICC_OK) {
                printf(" %s: %s\n", icc_status_name(status), error.message);
            } else {
                icc_match_info info = {.size = sizeof info};
                (void)icc_match_get_info(match, &info);
                printf(" %6zu %6zu -> %6zu (%zu joined) error %5.2f %% cost %.3f sure %.3f turn "
                       "%4.0f slopes %.2g..%.2g%s %.2f s\n",
                       given[0].n, given[1].n, info.n_vertices, info.n_joined,
                       100 * error_of(match, files, given), info.cost, info.sure, info.turn,
                       info.least_slope, info.most_slope, info.mirrored ? " mirrored" : "",
                       seconds);
                if (maps)
                    compare_maps(match, files);
            }
            icc_match_free(match);
            for (int e = 0; e < 2; ++e) {
                icc_domain_free(domain[e]);
                free(given[e].xy);
                free(given[e].label);
            }
        }
        free(files[0].xy);
        free(files[1].xy);
    }
    return 0;
}
