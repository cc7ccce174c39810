/* A function on all vertices of the simplices that meet a domain, from one on the vertices
 * inside. */
#ifndef ICCP_SMOOTH_H
#define ICCP_SMOOTH_H

#include "field/cover.h"
#include "function/function.h"

typedef struct iccp_smooth {
    iccp_memory memory;
    const icc_grid *grid; /* borrowed: that of the field's tree */
    uint32_t root;
    double *value;     /* one per vertex; 0 where no simplex needs one */
    int32_t *exponent; /* the function is value * 2^exponent; NULL: 0 everywhere, the usual
                          case */
    uint8_t *needed;   /* by vertex: 1 when it belongs to a simplex that meets the domain */
} iccp_smooth;

/* The values of `field` inside; outside next to them, 0; beyond, where the domain continues between
 * the vertices of the grid, less and less with every step. Then `sweeps` times the mean of each
 * value and the mean of its neighbours, the root's kept: that rids steps of the grid of nearly all
 * vertices from which not all simplices' gradients point to one side (bench_field). Free it in any
 * case. */
icc_status iccp_smooth_create(iccp_smooth *smooth, const icc_function *field,
                              const iccp_cover *cover, int sweeps, const iccp_env *env);
void iccp_smooth_free(iccp_smooth *smooth);

/* The function at a vertex as x * 2^exponent. */
static inline int32_t iccp_smooth_exponent(const iccp_smooth *smooth, uint32_t v)
{
    return smooth->exponent != NULL ? smooth->exponent[v] : 0;
}

static inline double iccp_smooth_get(const iccp_smooth *smooth, uint32_t v, int32_t exponent)
{
    if (smooth->exponent == NULL)
        return smooth->value[v];
    const int32_t shift = smooth->exponent[v] - exponent;
    return shift < -2000 ? 0.0 : ldexp(smooth->value[v], shift);
}

static inline void iccp_smooth_set(const iccp_smooth *smooth, uint32_t v, double x,
                                   int32_t exponent)
{
    if (smooth->exponent == NULL)
        smooth->value[v] = x;
    else
        iccp_scaled_set(&(iccp_scaled){smooth->value, smooth->exponent}, v, x, exponent);
}

#endif
