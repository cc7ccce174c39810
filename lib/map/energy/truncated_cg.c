/* Solves Newton's equations roughly by conjugate gradients, preconditioned by the points' diagonal
 * blocks: J. Nocedal, S. Wright, Numerical Optimization, section 7.1. In space the factors of a
 * whole mesh would fill up too much. */
#include "map/energy/truncated_cg.h"

#include "base/minmax.h"
#include "base/threads.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

/* A pivot below this share of its diagonal, in a point's block, is caused by rounding. */
static const double SMALLEST_PIVOT = 1e-13;

enum { MAX_DIRECTIONS = 200 };

/* Rows that a thread takes at once. */
enum { GRAIN = 2048 };

/* L D L^T of each point's block: three pivots and three entries of L. */
static void factorise_blocks(const iccp_symmetric *h, double *factor)
{
    for (size_t i = 0; i < h->n; i += 3, factor += 6) {
        const double *d = h->diagonal + i;
        const double *x = h->value + h->first[i], *y = h->value + h->first[i + 1];
        factor[0] = d[0];
        factor[3] = x[0] / d[0];
        factor[4] = x[1] / d[0];
        factor[1] = iccp_max(d[1] - factor[3] * x[0], SMALLEST_PIVOT * d[1]);
        const double rest = y[1] - factor[4] * x[0];
        factor[5] = rest / factor[1];
        factor[2] = iccp_max(d[2] - factor[4] * x[1] - factor[5] * rest, SMALLEST_PIVOT * d[2]);
    }
}

static void precondition(size_t n, const double *factor, const double *r, double *z)
{
    for (size_t i = 0; i < n; i += 3, factor += 6, r += 3, z += 3) {
        const double y1 = r[1] - factor[3] * r[0];
        const double y2 = r[2] - factor[4] * r[0] - factor[5] * y1;
        z[2] = y2 / factor[2];
        z[1] = y1 / factor[1] - factor[5] * z[2];
        z[0] = r[0] / factor[0] - factor[3] * z[1] - factor[4] * z[2];
    }
}

typedef struct product {
    const iccp_symmetric *h;
    const double *x;
    double *y;
} product;

static icc_status apply(void *argument, size_t begin, size_t end)
{
    const product *p = argument;
    const iccp_symmetric *h = p->h;
    for (size_t i = begin; i < end; ++i) {
        double sum = h->diagonal[i] * p->x[i];
        for (size_t k = h->first[i]; k < h->first[i + 1]; ++k)
            sum += h->value[k] * p->x[h->column[k]];
        p->y[i] = sum;
    }
    return ICC_OK;
}

/* Every iterate from 0 on is a direction of descent, so the loop may end anywhere. It ends when the
 * residual is small, or before a direction without positive curvature. */
icc_status iccp_truncated_cg(const iccp_symmetric *hessian, const double *gradient, double *step,
                             double residual, double *work, const char *stage, const iccp_env *env)
{
    const size_t n = hessian->n;
    double *r = work, *z = r + n, *p = z + n, *q = p + n, *factor = q + n;
    const iccp_env quiet = iccp_quiet(env);
    factorise_blocks(hessian, factor);
    for (size_t i = 0; i < n; ++i) {
        step[i] = 0;
        r[i] = -gradient[i];
    }
    precondition(n, factor, r, z);
    memcpy(p, z, n * sizeof *p);
    double rho = iccp_vec_dot(n, r, z);
    const double enough = residual * residual * rho;
    for (int k = 0; k < MAX_DIRECTIONS && rho > enough; ++k) {
        if (iccp_progress(env, stage, (double)k / MAX_DIRECTIONS) != ICC_OK)
            return ICC_ERR_CANCELLED;
        (void)iccp_for_chunks(&quiet, stage, n, GRAIN, apply, &(product){hessian, p, q});
        const double curvature = iccp_vec_dot(n, p, q);
        if (!(curvature > 0))
            break;
        const double length = rho / curvature;
        for (size_t i = 0; i < n; ++i) {
            step[i] += length * p[i];
            r[i] -= length * q[i];
        }
        precondition(n, factor, r, z);
        const double next = iccp_vec_dot(n, r, z), share = next / rho;
        rho = next;
        for (size_t i = 0; i < n; ++i)
            p[i] = z[i] + share * p[i];
    }
    return ICC_OK;
}
