/* Gaussians at points, by dense algebra: the thesis' own experiments (section 3.3), for
 * comparison. */
#ifndef TESTS_GAUSSIANS_H
#define TESTS_GAUSSIANS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* n points in the plane, the matrix of their kernel values and its Cholesky factor, row after
 * row. */
typedef struct gaussians {
    size_t n;
    const double *points;
    double sigma;
    double *matrix, *factor;
} gaussians;

static inline double gaussians_value(const gaussians *g, const double *p, size_t j)
{
    const double x = p[0] - g->points[2 * j], y = p[1] - g->points[2 * j + 1];
    return exp(-(x * x + y * y) / (2 * g->sigma * g->sigma));
}

/* False if the matrix is not positive definite. */
static inline bool gaussians_create(gaussians *g, size_t n, const double *points, double sigma)
{
    *g = (gaussians){n, points, sigma, malloc(n * n * sizeof(double)),
                     malloc(n * n * sizeof(double))};
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < n; ++j)
            g->matrix[n * i + j] = g->factor[n * i + j] = gaussians_value(g, points + 2 * i, j);
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j <= i; ++j) {
            double *a = g->factor + n * i, *b = g->factor + n * j, sum = a[j];
            for (size_t k = 0; k < j; ++k)
                sum -= a[k] * b[k];
            if (i == j && !(sum > 0))
                return false;
            a[j] = i == j ? sqrt(sum) : sum / b[j];
        }
    return true;
}

static inline void gaussians_free(gaussians *g)
{
    free(g->matrix);
    free(g->factor);
}

/* x: the right side, then the solution. */
static inline void gaussians_solve(const gaussians *g, double *x)
{
    for (size_t i = 0; i < g->n; ++i) {
        const double *row = g->factor + g->n * i;
        for (size_t k = 0; k < i; ++k)
            x[i] -= row[k] * x[k];
        x[i] /= row[i];
    }
    for (size_t i = g->n; i-- > 0;) {
        const double *row = g->factor + g->n * i;
        x[i] /= row[i];
        for (size_t k = 0; k < i; ++k)
            x[k] -= row[k] * x[i];
    }
}

/* The eigenvalue that repeated multiplication, or solution, tends to. */
static inline double gaussians_eigenvalue(const gaussians *g, bool least)
{
    double *x = malloc(2 * g->n * sizeof *x), *y = x + g->n, norm = 0;
    for (size_t i = 0; i < g->n; ++i)
        x[i] = 1 + 0.5 * sin(1e4 * (double)(i * i));
    for (int step = 0; step < 60; ++step) {
        norm = 0;
        for (size_t i = 0; i < g->n; ++i) {
            y[i] = least ? x[i] : 0;
            for (size_t j = 0; !least && j < g->n; ++j)
                y[i] += g->matrix[g->n * i + j] * x[j];
        }
        if (least)
            gaussians_solve(g, y);
        for (size_t i = 0; i < g->n; ++i)
            norm += y[i] * y[i];
        norm = sqrt(norm);
        for (size_t i = 0; i < g->n; ++i)
            x[i] = y[i] / norm;
    }
    free(x);
    return least ? 1 / norm : norm;
}

typedef struct gaussians_report {
    double condition, unity, reproduction, reproduction_mean, lagrange;
} gaussians_report;

/* Deviations on a grid of count^2 points over the square of half-side `half`, in the maximum
 * norm. */
static inline void gaussians_deviations(const gaussians *g, int count, double half,
                                        gaussians_report *r)
{
    double *f[3];
    for (int c = 0; c < 3; ++c) {
        f[c] = malloc(g->n * sizeof(double));
        for (size_t i = 0; i < g->n; ++i)
            f[c][i] = c < 2 ? g->points[2 * i + (size_t)c] : 1;
        gaussians_solve(g, f[c]);
    }
    for (int i = 0; i < count * count; ++i) {
        const double p[2] = {half * (2.0 * (i % count) / (count - 1) - 1),
                             half * (2.0 * (i / count) / (count - 1) - 1)};
        double sum[3] = {0, 0, 0};
        for (size_t j = 0; j < g->n; ++j) {
            const double value = gaussians_value(g, p, j);
            for (int c = 0; c < 3; ++c)
                sum[c] += value * f[c][j];
        }
        const double miss = fmax(fabs(sum[0] - p[0]), fabs(sum[1] - p[1]));
        r->unity = fmax(r->unity, fabs(sum[2] - 1));
        r->reproduction = fmax(r->reproduction, miss);
        r->reproduction_mean += miss / (count * count);
    }
    for (int c = 0; c < 3; ++c)
        free(f[c]);
}

/* The sum of |a_i(x_j) - delta_ij| over all i and the points j within the square. */
static inline double gaussians_lagrange(const gaussians *g, double half)
{
    double *column = malloc(g->n * sizeof *column), sum = 0;
    for (size_t j = 0; j < g->n; ++j) {
        if (fabs(g->points[2 * j]) > half || fabs(g->points[2 * j + 1]) > half)
            continue;
        memcpy(column, g->matrix + g->n * j, g->n * sizeof *column);
        gaussians_solve(g, column);
        for (size_t i = 0; i < g->n; ++i)
            sum += fabs(column[i] - (i == j));
    }
    free(column);
    return sum;
}

/* `inner`: the half-side of the square whose points take part in the Lagrange property. */
static inline gaussians_report gaussians_measure(const gaussians *g, int count, double half,
                                                 double inner)
{
    gaussians_report r = {0};
    r.condition = gaussians_eigenvalue(g, false) / gaussians_eigenvalue(g, true);
    gaussians_deviations(g, count, half, &r);
    r.lagrange = gaussians_lagrange(g, inner);
    return r;
}

#endif
