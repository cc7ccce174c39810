/* Extends a function from the inside vertices to all vertices of the simplices that meet a domain.
 *
 * Source: docs/theory/charts-space.md, "fields on grids", step 1. */
#ifndef ICCP_EXTENSION_H
#define ICCP_EXTENSION_H

#include "field/incidence.h"
#include "gradient/function/function.h"

typedef struct iccp_extension {
    iccp_memory memory;
    const icc_grid *grid; /* borrowed: the grid of the field's tree */
    uint32_t root;
    double *value;     /* one per vertex; 0 where no simplex needs one */
    int32_t *exponent; /* the function is value * 2^exponent; usually NULL, for exponent 0
                          everywhere */
    uint8_t *needed;   /* by vertex: 1 if it belongs to a simplex that meets the domain */
} iccp_extension;

/* Copies the values of the function `field` inside. Outside vertices next to the inside get 0. If
 * the domain continues between the vertices of the grid, the values beyond fall with every step.
 *
 * Then each of the `sweeps` replaces every value but the root's by the mean of itself and the mean
 * of its neighbours. This smooths steps of the grid. It removes nearly all vertices that have
 * gradients without a common uphill vector (bench_field). Free the extension in any case. */
icc_status iccp_extension_create(iccp_extension *extension, const icc_function *field,
                                 const iccp_incidence *incidence, int sweeps, const iccp_env *env);
void iccp_extension_free(iccp_extension *extension);

/* The function at a vertex as x * 2^exponent. */
static inline int32_t iccp_extension_exponent(const iccp_extension *extension, uint32_t v)
{
    return extension->exponent != NULL ? extension->exponent[v] : 0;
}

static inline double iccp_extension_get(const iccp_extension *extension, uint32_t v,
                                        int32_t exponent)
{
    if (extension->exponent == NULL)
        return extension->value[v];
    const int32_t shift = extension->exponent[v] - exponent;
    return shift < -2000 ? 0.0 : ldexp(extension->value[v], shift);
}

static inline void iccp_extension_set(const iccp_extension *extension, uint32_t v, double x,
                                      int32_t exponent)
{
    if (extension->exponent == NULL)
        extension->value[v] = x;
    else
        iccp_scaled_set(&(iccp_scaled){extension->value, extension->exponent}, v, x, exponent);
}

#endif
