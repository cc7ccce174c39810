/* Maps of random pairs of domains with features, from source to target and back: how many are not
 * made or not certified, their energies, and what they cost in processor time. The figures at the
 * end are those of one run; those of several, over parts of the seeds, add up, but for quantiles.
 * usage: bench_features [NUMBER [FIRST_SEED [ITERATIONS [DIGITS]]]], iterations as icc_map_options
 * has them; with digits, features crowd, as near to each other as so many decimals say */

#include "../flat_mesh.h"
#include "bench.h"
#include "feature_mixes.h"
#include "math/predicates.h"

typedef struct tally {
    size_t n, n_errors, n_uncertified, n_infinite, n_off, n_lost, n_flat;
    double *energy, *seconds, *triangles;
} tally;

/* Triangles that are not positive, in the coordinates that the caller gets; those of domains far
 * from zero are rounded. */
static size_t count_flat(const icc_map *map, const icc_map_info *info)
{
    double *points = bench_alloc(info->n_vertices, 2 * sizeof *points);
    double *images = bench_alloc(info->n_vertices, 2 * sizeof *images);
    uint32_t *corners = bench_alloc(info->n_simplices, 3 * sizeof *corners);
    size_t n = 0;
    if (flat_get_mesh(map, points, images, corners) != ICC_OK)
        n = SIZE_MAX;
    for (size_t t = 0; n < SIZE_MAX && t < info->n_simplices; ++t) {
        const size_t a = 2 * (size_t)corners[3 * t], b = 2 * (size_t)corners[3 * t + 1],
                     c = 2 * (size_t)corners[3 * t + 2];
        n += iccp_orient2d(points + a, points + b, points + c) <= 0 ||
             iccp_orient2d(images + a, images + b, images + c) <= 0;
    }
    free(points);
    free(images);
    free(corners);
    return n;
}

static void report(const char *what, uint64_t seed, int swapped, double figure)
{
    printf("  seed %llu%s: %s %g\n", (unsigned long long)seed, swapped ? " swapped" : "", what,
           figure);
}

static void try_map(tally *t, const feature_mix *m, uint64_t seed, bool swapped, int32_t iterations)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_map_info info = {.size = sizeof info};
    icc_error error = {.size = sizeof error};
    icc_map *map;
    const double begin = bench_processor_seconds();
    const icc_status status =
        icc_map_create(&map, m->domain[swapped], m->domain[!swapped], &options, NULL, &error);
    t->seconds[t->n] = bench_processor_seconds() - begin;
    t->energy[t->n] = HUGE_VAL;
    if (status == ICC_OK) {
        (void)icc_map_get_info(map, &info);
        const size_t n_off = mix_count_off(m, map, swapped), n_lost = mix_count_lost(m, map, seed);
        const size_t n_flat = m->offset > 0 ? 0 : count_flat(map, &info);
        const bool is_finite = info.energy >= 4 - 1e-6 && info.energy < HUGE_VAL;
        t->energy[t->n] = info.energy;
        t->triangles[t->n] = (double)info.n_simplices;
        t->n_uncertified += info.certified != 1;
        t->n_infinite += !is_finite;
        t->n_off += n_off > 0;
        t->n_lost += n_lost > 0;
        t->n_flat += n_flat > 0;
        if (info.certified != 1)
            report("not certified", seed, swapped, info.energy);
        if (!is_finite)
            report("energy", seed, swapped, info.energy);
        if (n_off > 0)
            report("vertices off", seed, swapped, (double)n_off);
        if (n_lost > 0)
            report("points lost", seed, swapped, (double)n_lost);
        if (n_flat > 0)
            report("triangles not positive", seed, swapped, (double)n_flat);
    } else {
        ++t->n_errors;
        report(error.message, seed, swapped, (double)m->n_features);
    }
    ++t->n;
    icc_map_free(map);
}

static int by_size(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static void print_quantiles(const char *name, size_t n, double *figures, double factor)
{
    static const double share[] = {0.1, 0.5, 0.9, 0.99, 0.999, 1};
    double sum = 0;
    qsort(figures, n, sizeof *figures, by_size);
    for (size_t k = 0; k < n; ++k)
        sum += figures[k];
    printf("%-10s", name);
    for (size_t k = 0; k < sizeof share / sizeof *share; ++k)
        printf(" %10.4g", factor * figures[(size_t)(share[k] * (double)(n - 1))]);
    printf(" %10.4g\n", factor * sum / (double)n);
}

int main(int argc, char **argv)
{
    const uint64_t n = argc > 1 ? strtoull(argv[1], NULL, 10) : 10000;
    const uint64_t first = argc > 2 ? strtoull(argv[2], NULL, 10) : 0;
    const int32_t iterations = argc > 3 ? (int32_t)strtol(argv[3], NULL, 10) : 0;
    const double digits = argc > 4 ? strtod(argv[4], NULL) : 0;
    tally t = {.energy = bench_alloc(2 * n, sizeof *t.energy),
               .seconds = bench_alloc(2 * n, sizeof *t.seconds),
               .triangles = bench_alloc(2 * n, sizeof *t.triangles)};
    for (uint64_t seed = first; seed < first + n; ++seed) {
        feature_mix m;
        mix_create_crowded(&m, seed, digits);
        try_map(&t, &m, seed, false, iterations);
        try_map(&t, &m, seed, true, iterations);
        mix_free(&m);
        (void)fflush(stdout);
    }
    printf("%llu mixes from seed %llu on, %zu maps: %zu errors, %zu uncertified, %zu of infinite "
           "energy;\n%zu with vertices off their targets, %zu with points that do not come back, "
           "%zu with triangles that are not positive\n",
           (unsigned long long)n, (unsigned long long)first, t.n, t.n_errors, t.n_uncertified,
           t.n_infinite, t.n_off, t.n_lost, t.n_flat);
    printf("quantiles         10 %%       50 %%       90 %%       99 %%     99.9 %%    largest"
           "       mean\n");
    if (t.n > 0) {
        print_quantiles("energy", t.n, t.energy, 1);
        print_quantiles("cpu ms", t.n, t.seconds, 1e3);
        print_quantiles("triangles", t.n, t.triangles, 1);
    }
    free(t.energy);
    free(t.seconds);
    free(t.triangles);
    return t.n_errors + t.n_uncertified + t.n_infinite + t.n_off + t.n_lost + t.n_flat > 0;
}
