/* What it costs to make a domain, to list the defects of its boundary, and to locate a point: for
 * outlines of 10 to 23,000 vertices, ordinary and unpleasant ones.
 * usage: bench_domain [FILE...]   (each FILE: one "x y" per line) */
#define _POSIX_C_SOURCE 200809L

#include "icc/icc.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MAX_VERTICES = 1 << 18, N_QUERIES = 1 << 20 };

static double vertices[2 * MAX_VERTICES], queries[2 * N_QUERIES], bary[2 * N_QUERIES];
static int32_t where[N_QUERIES];
static uint32_t facet[N_QUERIES];

static double now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double random_unit(void)
{
    static uint64_t state = 1;
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (double)(state >> 11) * 0x1p-53;
}

static void put(size_t i, double x, double y)
{
    vertices[2 * i] = x;
    vertices[2 * i + 1] = y;
}

static void make_circle(size_t n)
{
    for (size_t i = 0; i < n; ++i)
        put(i, cos(6.283185307179586 * (double)i / (double)n),
            sin(6.283185307179586 * (double)i / (double)n));
}

/* A star with smooth lobes and rough edges. */
static void make_coast(size_t n)
{
    for (size_t i = 0; i < n; ++i) {
        const double angle = 6.283185307179586 * (double)i / (double)n;
        const double radius =
            1 + 0.5 * sin(7 * angle) + 0.2 * sin(31 * angle) + 20 * random_unit() / (double)n;
        put(i, radius * cos(angle), radius * sin(angle));
    }
}

/* Long thin teeth along (dx, dy); along a diagonal all their boxes overlap. */
static void make_comb(size_t n, double dx, double dy)
{
    const double width = 1.0 / (double)n;
    for (size_t i = 0; i + 2 < n; ++i) {
        const double u = i % 2 == 0 ? 0 : 1, v = width * (double)i;
        put(i, dx * u - dy * v, dy * u + dx * v);
    }
    put(n - 2, -0.01 * dx - dy, -0.01 * dy + dx);
    put(n - 1, -0.01 * dx, -0.01 * dy);
}

static void make_spiral(size_t n)
{
    const size_t half = n / 2;
    for (size_t i = 0; i < half; ++i) {
        const double turns = half < 1000 ? 0.06 * (double)half : 60;
        const double angle = turns * 6.283185307179586 * (double)i / (double)half;
        put(i, (1 + angle) * cos(angle), (1 + angle) * sin(angle));
        put(2 * half - 1 - i, (3 + angle) * cos(angle), (3 + angle) * sin(angle));
    }
}

static size_t read_file(const char *path)
{
    FILE *file = fopen(path, "r");
    size_t n = 0;
    if (file == NULL)
        return 0;
    while (n < MAX_VERTICES && fscanf(file, "%lf%lf", &vertices[2 * n], &vertices[2 * n + 1]) == 2)
        ++n;
    (void)fclose(file);
    return n;
}

static double time_create(size_t n, icc_domain **domain)
{
    double best = HUGE_VAL;
    icc_error err = {.size = sizeof err};
    for (int i = 0; i < 5; ++i) {
        if (i > 0)
            icc_domain_free(*domain);
        const double start = now();
        if (icc_domain_create(domain, 2, n, vertices, 0, NULL, NULL, &err) != ICC_OK) {
            (void)printf("%s\n", err.message);
            return HUGE_VAL;
        }
        best = fmin(best, now() - start);
    }
    return best;
}

static void measure(const char *name, size_t n)
{
    icc_domain *domain;
    icc_domain_info info = {.size = sizeof info};
    size_t n_defects;
    const double create = time_create(n, &domain);
    if (domain == NULL)
        return;
    const double start = now();
    (void)icc_boundary_defects(n, vertices, 0, NULL, NULL, &n_defects, NULL, NULL);
    const double listed = now();
    (void)icc_domain_get_info(domain, &info);
    for (size_t i = 0; i < 2 * (size_t)N_QUERIES; ++i)
        queries[i] = info.lower[i % 2] + random_unit() * (info.upper[i % 2] - info.lower[i % 2]);
    const double begin = now();
    (void)icc_domain_locate(domain, N_QUERIES, queries, where, NULL, NULL, NULL);
    const double located = now();
    (void)icc_domain_locate(domain, N_QUERIES / 16, queries, where, facet, bary, NULL);
    const double found = now();
    (void)printf("%-34.34s %6zu %10.3f %10.3f %9.1f %9.1f\n", name, n, 1e3 * create,
                 1e3 * (listed - start), 1e9 * (located - begin) / N_QUERIES,
                 16e9 * (found - located) / N_QUERIES);
    icc_domain_free(domain);
}

int main(int argc, char **argv)
{
    (void)printf("%-34s %6s %10s %10s %9s %9s\n", "", "n", "create ms", "list ms", "locate ns",
                 "nearest ns");
    for (int i = 1; i < argc; ++i) {
        const char *slash = strrchr(argv[i], '/');
        measure(slash != NULL ? slash + 1 : argv[i], read_file(argv[i]));
    }
    for (size_t n = 10; n <= 23000; n = n < 10000 ? 10 * n : n + 13000) {
        make_circle(n);
        measure("circle", n);
        make_coast(n);
        measure("coast", n);
        make_comb(n, 1, 0);
        measure("comb", n);
        make_comb(n, 1, 1);
        measure("diagonal comb", n);
        make_spiral(n);
        measure("spiral", n);
    }
    return 0;
}
