/* The R_d sequence: multiples of (1/g, 1/g^2, ..) modulo 1, where g^(d+1) = g + 1. M. Roberts, The
 * unreasonable effectiveness of quasirandom sequences, 2018. */
#include "report/sample.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BATCH = 4096, MAX_BATCHES = 1000 };

/* Computes the root by iteration, which gains a digit or two in each step. */
static double root(size_t dim)
{
    double g = 1.3;
    for (int i = 0; i < 64; i++)
        g = pow(1 + g, 1 / (double)(dim + 1));
    return g;
}

static void fill(double *batch, size_t first, const icc_domain_info *box)
{
    size_t dim = (size_t)box->dim;
    double step[ICC_MAX_DIM], g = root(dim);
    for (size_t k = 0; k < dim; k++)
        step[k] = k == 0 ? 1 / g : step[k - 1] / g;
    for (size_t i = 0; i < BATCH; i++)
        for (size_t k = 0; k < dim; k++) {
            double u = fmod(0.5 + (double)(first + i + 1) * step[k], 1.0);
            batch[dim * i + k] = box->lower[k] * (1 - u) + box->upper[k] * u;
        }
}

size_t sample_inside(const icc_domain *domain, size_t n, double *points, const icc_env *env)
{
    icc_domain_info info = {.size = sizeof info};
    if (icc_domain_get_info(domain, &info) != ICC_OK)
        return 0;
    size_t dim = (size_t)info.dim, found = 0;
    double *batch = need(BATCH, dim * sizeof *batch);
    int32_t *where = need(BATCH, sizeof *where);
    for (size_t b = 0; b < MAX_BATCHES && found < n; b++) {
        fill(batch, b * BATCH, &info);
        if (icc_domain_locate(domain, BATCH, batch, where, NULL, NULL, env) != ICC_OK)
            break;
        for (size_t i = 0; i < BATCH && found < n; i++)
            if (where[i] == ICC_INSIDE)
                memcpy(points + dim * found++, batch + dim * i, dim * sizeof *batch);
    }
    free(batch);
    free(where);
    return found;
}
