/* Optimality under inequalities along a tree. Each unknown except the root has one multiplier, that
 * of the edge to its parent. So stationarity is a triangular system. */
#include "gradient/solver/inequalities.h"

#include "base/minmax.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>

/* Returns entry i as a double. If `exponent` is NULL, all exponents are 0. */
static double plain(const iccp_scaled *vector, size_t i)
{
    return vector->exponent == NULL ? vector->fraction[i] : iccp_scaled_get(vector, i, 0);
}

/* Returns true if sigma * child, rounded, exceeds the parent. */
static bool is_violated(const iccp_scaled *f, double sigma, size_t parent, size_t child)
{
    const int32_t shift = f->exponent[child] - f->exponent[parent];
    return iccp_ldexp(sigma * f->fraction[child], shift) > f->fraction[parent];
}

size_t iccp_inequalities_violated(const iccp_unknowns *unknowns, double eta, const iccp_scaled *f)
{
    size_t n_violated = 0;
    for (size_t k = 1; k < unknowns->n; ++k)
        n_violated += is_violated(f, 1 + eta, unknowns->parent[k], k);
    return n_violated;
}

void iccp_inequalities_sweep(const iccp_unknowns *unknowns, double eta, const iccp_scaled *f)
{
    const double sigma = 1 + eta;
    for (size_t k = 1; k < unknowns->n; ++k) {
        const uint32_t p = unknowns->parent[k];
        if (!is_violated(f, sigma, p, k))
            continue;
        double x = f->fraction[p] / sigma;
        iccp_scaled_set(f, k, x, f->exponent[p]);
        while (is_violated(f, sigma, p, k)) { /* the quotient was rounded up */
            x = nextafter(x, 0);
            iccp_scaled_set(f, k, x, f->exponent[p]);
        }
    }
}

double iccp_laplacian_row(const iccp_unknowns *unknowns, const iccp_scaled *f, size_t k,
                          int32_t exponent)
{
    const double own = iccp_scaled_get(f, k, exponent);
    const uint32_t *neighbour = unknowns->neighbour + k * (size_t)unknowns->n_neighbours;
    double sum = 0;
    for (int32_t d = 0; d < unknowns->n_neighbours; ++d)
        sum += neighbour[d] == ICCP_NONE ? own * iccp_unknowns_slope(unknowns, k, d)
                                         : own - iccp_scaled_get(f, neighbour[d], exponent);
    return sum;
}

/* A leaf's bound and its edge pull at the same value. If both are tight, the edge's multiplier may
 * be raised freely, and the bound's with it. This continues up the tree as long as edges are tight.
 * `lift` is the least cost of doing so below an unknown: the largest slack on the way, which bounds
 * a residual where the multipliers are positive. */
double iccp_inequalities_residual(const iccp_unknowns *unknowns, double eta, double leaf,
                                  const iccp_scaled *f, const iccp_scaled *gradient, double *work)
{
    const double sigma = 1 + eta;
    double *sum = work, *lift = work + unknowns->n;
    double residual = 0;
    assert(eta > 0 && leaf >= 0);
    for (size_t k = 0; k < unknowns->n; ++k) {
        sum[k] = 0;
        lift[k] = -1; /* no child has been here */
    }
    for (size_t k = unknowns->n; k-- > 1;) {
        const uint32_t p = unknowns->parent[k];
        const double own = plain(f, k), slack = plain(f, p) - sigma * own;
        double lambda = (sum[k] - plain(gradient, k)) / sigma;
        if (lift[k] < 0 && leaf > 0) { /* no children: the bound absorbs a downward pull */
            residual = iccp_max(residual, fabs(iccp_min(own - leaf, iccp_max(0, -sigma * lambda))));
            lambda = iccp_max(0, lambda);
        }
        if (lift[k] < 0)
            lift[k] = leaf > 0 ? fabs(own - leaf) : HUGE_VAL;
        const double price = iccp_max(lift[k], fabs(slack));
        if (lambda < 0 && lift[k] < -lambda) {
            residual = iccp_max(residual, lift[k]);
            lambda = 0;
        }
        residual = iccp_max(residual, fabs(iccp_min(slack, lambda)));
        lift[p] = lift[p] < 0 ? price : iccp_min(lift[p], price);
        sum[p] += lambda;
    }
    return residual;
}
