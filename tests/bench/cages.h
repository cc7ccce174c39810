/* What the benchmarks of maps share: cages from files, evenly spread points, how fair a map is. */
#ifndef TESTS_BENCH_CAGES_H
#define TESTS_BENCH_CAGES_H

#include "bench.h"

enum { CAGE_MOST = 100000 };

/* A file with one vertex, `x y`, per line. */
static inline icc_domain *cage_read(const char *path)
{
    double *xy = bench_alloc(CAGE_MOST, 2 * sizeof *xy);
    FILE *file = fopen(path, "r");
    if (file == NULL) {
        perror(path);
        exit(EXIT_FAILURE);
    }
    size_t n = 0;
    while (n < CAGE_MOST && fscanf(file, "%lf %lf", &xy[2 * n], &xy[2 * n + 1]) == 2)
        ++n;
    fclose(file);
    icc_domain *domain = bench_domain(n, xy);
    free(xy);
    return domain;
}

static inline const char *cage_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

static inline icc_domain_info cage_info(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    bench_check(icc_domain_get_info(domain, &info), &(icc_error){.size = sizeof(icc_error)});
    return info;
}

/* Points spread evenly inside a domain by the R2 sequence (M. Roberts, 2018). How many there are:
 * n, unless the domain is so thin that a thousand tries a point do not suffice. */
static inline size_t cage_points(const icc_domain *domain, size_t n, double *points)
{
    const icc_domain_info info = cage_info(domain);
    size_t found = 0;
    for (size_t i = 0; i < 1000 * n && found < n; ++i) {
        const double u = fmod(0.5 + 0.75487766624669276 * (double)i, 1);
        const double v = fmod(0.5 + 0.56984029099805327 * (double)i, 1);
        const double p[2] = {info.lower[0] + u * (info.upper[0] - info.lower[0]),
                             info.lower[1] + v * (info.upper[1] - info.lower[1])};
        int32_t where = ICC_OUTSIDE;
        (void)icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL);
        if (where == ICC_INSIDE)
            memcpy(points + 2 * found++, p, sizeof p);
    }
    return found;
}

static inline double cage_diagonal(const icc_domain *domain)
{
    const icc_domain_info info = cage_info(domain);
    return hypot(info.upper[0] - info.lower[0], info.upper[1] - info.lower[1]);
}

static inline int cage_compare(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The value that a share of the n values, which get sorted, does not exceed. */
static inline double cage_quantile(double *values, size_t n, double share)
{
    if (n == 0)
        return NAN;
    qsort(values, n, sizeof *values, cage_compare);
    return values[(size_t)(share * (double)(n - 1) + 0.5)];
}

/* Determinants this small, both shapes scaled to area 1, are rounding. */
static const double CAGE_FLAT = 1e-9;

/* The symmetric Dirichlet energy |J|^2 + |J^-1|^2 at evenly spread points, both shapes scaled to
 * area 1: 4 for an isometry. Points where the map has no derivative, collapses or turns over are
 * left out and counted. */
typedef struct cage_energy {
    double mean, median, high; /* high: 99 % */
    double left_out;           /* share */
} cage_energy;

static inline cage_energy cage_measure_energy(const icc_map *map, const icc_domain *source,
                                              const icc_domain *target, size_t n)
{
    double *points = bench_alloc(n, 2 * sizeof *points);
    double *jacobians = bench_alloc(n, 4 * sizeof *jacobians);
    double *energies = bench_alloc(n, sizeof *energies);
    icc_error error = {.size = sizeof error};
    n = cage_points(source, n, points);
    bench_check(icc_map_jacobian(map, n, points, jacobians, NULL, NULL, NULL), &error);
    const double ratio = cage_info(target).measure / cage_info(source).measure;
    size_t kept = 0;
    double sum = 0;
    for (size_t i = 0; i < n; ++i) {
        const double *j = jacobians + 4 * i;
        const double det = (j[0] * j[3] - j[1] * j[2]) / ratio;
        const double square = (j[0] * j[0] + j[1] * j[1] + j[2] * j[2] + j[3] * j[3]) / ratio;
        if (det > CAGE_FLAT) {
            energies[kept] = square + square / (det * det);
            sum += energies[kept++];
        }
    }
    const cage_energy energy = {.mean = sum / (double)kept,
                                .median = cage_quantile(energies, kept, 0.5),
                                .high = cage_quantile(energies, kept, 0.99),
                                .left_out = (double)(n - kept) / (double)n};
    free(points);
    free(jacobians);
    free(energies);
    return energy;
}

#endif
