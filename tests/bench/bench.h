/* What the benchmarks share: a clock, pairs of shapes, evenly spread points. */
#ifndef TESTS_BENCH_H
#define TESTS_BENCH_H

#include <icc/icc.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static inline double bench_seconds(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Of this process on all processors: what others do on a busy machine does not count. */
static inline double bench_processor_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static inline void bench_check(icc_status status, const icc_error *error)
{
    if (status == ICC_OK)
        return;
    fprintf(stderr, "%s: %s\n", icc_status_name(status), error->message);
    exit(EXIT_FAILURE);
}

static inline void *bench_alloc(size_t n, size_t size)
{
    void *memory = calloc(n, size);
    if (memory == NULL) {
        fprintf(stderr, "out of memory\n");
        exit(EXIT_FAILURE);
    }
    return memory;
}

/* A polygon before and after; vertex i goes to vertex i. */
enum { BENCH_MOST = 40 };
typedef struct bench_pair {
    const char *name;
    size_t n;
    double source[BENCH_MOST][2], target[BENCH_MOST][2];
} bench_pair;

static inline void bench_polar(double xy[2], double radius, double degrees)
{
    xy[0] = radius * cos(degrees * 3.14159265358979323846 / 180);
    xy[1] = radius * sin(degrees * 3.14159265358979323846 / 180);
}

/* A star with five tips, and the same turned by 12 degrees at the tips and by 31 at the dents. */
static inline bench_pair bench_star(void)
{
    bench_pair pair = {.name = "star", .n = 10};
    for (size_t i = 0; i < pair.n; ++i) {
        const double radius = i % 2 == 0 ? 1 : 0.42;
        const double degrees = 90 + 36 * (double)i;
        bench_polar(pair.source[i], radius, degrees);
        bench_polar(pair.target[i], radius, degrees - (i % 2 == 0 ? 12 : 31));
    }
    return pair;
}

/* A band of changing width round the curve y = 0.15 sin x, and the same bent to a C. */
static inline bench_pair bench_worm(void)
{
    bench_pair pair = {.name = "worm", .n = BENCH_MOST};
    for (size_t i = 0; i < pair.n; ++i) {
        const double angle = 6.28318530717958647692 * (double)i / (double)pair.n;
        const double x = 2 * cos(angle);
        const double y = sin(angle) * (0.5 + 0.15 * cos(2.5 * x)) + 0.15 * sin(2 * x);
        pair.source[i][0] = x;
        pair.source[i][1] = y;
        bench_polar(pair.target[i], 1.3 + y, 90 - 55 * x);
    }
    return pair;
}

enum { BENCH_PAIRS = 4 };

static inline bench_pair bench_number(int k)
{
    static const bench_pair dart = {.name = "dart",
                                    .n = 4,
                                    .source = {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                                    .target = {{0, 0}, {1, 0}, {0.3, 0.3}, {0, 1}}};
    static const bench_pair l = {
        .name = "L",
        .n = 6,
        .source = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}},
        .target = {{0, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}},
    };
    return k == 0 ? dart : k == 1 ? l : k == 2 ? bench_star() : bench_worm();
}

static inline icc_domain *bench_domain(size_t n, const double *xy)
{
    icc_domain *domain;
    icc_error error = {.size = sizeof error};
    bench_check(icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, &error), &error);
    return domain;
}

#endif
