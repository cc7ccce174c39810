/* Measures how the inside of a shape changes under a map, by its derivative. */
#include "base/allocate.h"
#include "report/info.h"
#include "report/sample.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N_SAMPLES = 4096 };

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void summarise(map_shares *s, size_t n, double *energies)
{
    if (n == 0)
        return;
    for (size_t i = 0; i < n; i++)
        s->mean += energies[i] / (double)n;
    qsort(energies, n, sizeof *energies, compare_numbers);
    s->median = energies[n / 2];
    s->nearly_all = energies[(n - 1) * 99 / 100];
}

/* Inverts a matrix of n rows (Gauss and Jordan, with row pivots) and returns its determinant. If
 * that is 0, the rest is undefined. */
static double invert(size_t n, double *a)
{
    double inverse[ICC_MAX_DIM * ICC_MAX_DIM] = {0}, det = 1;
    for (size_t i = 0; i < n; i++)
        inverse[n * i + i] = 1;
    for (size_t c = 0; c < n; c++) {
        size_t pivot = c;
        for (size_t r = c + 1; r < n; r++)
            pivot = fabs(a[n * r + c]) > fabs(a[n * pivot + c]) ? r : pivot;
        double top = a[n * pivot + c];
        det *= pivot == c ? top : -top;
        for (size_t k = 0; k < n; k++) {
            double x = a[n * pivot + k] / top, y = inverse[n * pivot + k] / top;
            a[n * pivot + k] = a[n * c + k];
            inverse[n * pivot + k] = inverse[n * c + k];
            a[n * c + k] = x;
            inverse[n * c + k] = y;
        }
        for (size_t r = 0; r < n; r++) {
            double factor = a[n * r + c];
            for (size_t k = 0; k < n && r != c; k++) {
                a[n * r + k] -= factor * a[n * c + k];
                inverse[n * r + k] -= factor * inverse[n * c + k];
            }
        }
    }
    memcpy(a, inverse, n * n * sizeof *a);
    return det;
}

static double squares(size_t n, const double *a)
{
    double sum = 0;
    for (size_t i = 0; i < n * n; i++)
        sum += a[i] * a[i];
    return sum;
}

/* Sorts the sampled points into shares. `growth` is the mean change of the measure; the Jacobians
 * are scaled so that it becomes 1. */
static void share_out(map_shares *s, size_t dim, double *jacobians, double growth)
{
    const double collapse = 1e-9; /* a point is collapsed if less of the mean change of measure
                                     is left */
    const double one = 1.0 / (double)s->n, scale = pow(growth, -1.0 / (double)dim);
    double *energies = need(s->n, sizeof *energies);
    size_t n = 0;
    for (size_t i = 0; i < s->n; i++) {
        double *jacobian = jacobians + dim * dim * i;
        for (size_t k = 0; k < dim * dim; k++)
            jacobian[k] *= scale;
        double forward = squares(dim, jacobian), det = invert(dim, jacobian);
        if (isnan(forward))
            s->without_image += one;
        else if (!(fabs(det) >= collapse))
            s->collapsed += one;
        else if (det < 0)
            s->inverted += one;
        else
            energies[n++] = forward + squares(dim, jacobian);
    }
    summarise(s, n, energies);
    free(energies);
}

int info_measure_map(info *x)
{
    job *j = &x->job;
    size_t dim = job_dim(j);
    icc_domain_info target = {.size = sizeof target};
    icc_map_get_info(j->map, &x->map);
    icc_map_get_report(j->map, &x->made);
    icc_domain_get_info(j->domains[1], &target);
    double *points = need(N_SAMPLES, dim * sizeof *points),
           *jacobians = need(N_SAMPLES, dim * dim * sizeof *jacobians);
    x->shares.n = sample_inside(j->domains[0], N_SAMPLES, points, &j->env);
    icc_status ran = icc_map_jacobian(j->map, x->shares.n, points, jacobians, NULL, NULL, &j->env);
    if (ran == ICC_OK && x->shares.n > 0)
        share_out(&x->shares, dim, jacobians, fabs(target.measure / x->domain.measure));
    free(points);
    free(jacobians);
    return ran == ICC_OK ? DONE : job_failed_status(j, ran);
}
