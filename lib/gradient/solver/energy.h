/* The bending energy 1/2 |A f|^2 of functions on the unknowns, A f being their Laplacian, and its
 * minimum under fixed and tied values. */
#ifndef ICCP_ENERGY_H
#define ICCP_ENERGY_H

#include "gradient/solver/unknowns.h"
#include "icc/stages.h"
#include "math/gram.h"

/* The Laplacians of the vertices inside, one row of A each in the order of `unknowns`, and for
 * ICC_FUNCTION_CLAMPED below them those of the vertices outside next to them, whether or not the
 * grid has them. One column per vertex inside; f is 0 outside. */
icc_status iccp_energy_create(iccp_sparse *a, const iccp_unknowns *unknowns, int32_t function,
                              const iccp_env *env);

/* out = A'A f; `work`: a->n_rows doubles. With A f first, digits that A'A would lose are kept. */
void iccp_energy_gradient(const iccp_sparse *a, const double *f, double *work, double *out);

/* f_k = share_k x_variable(k), or what f_k is where variable(k) == ICCP_NONE. */
typedef struct iccp_reduction {
    size_t n_variables;
    const uint32_t *variable; /* per unknown: its free variable, or ICCP_NONE */
    const double *share;      /* > 0 where there is a variable */
} iccp_reduction;

/* Finds the least energy among such f. On entry f holds the known values; on return all. Refined
 * until nothing improves any more, so that the error is about that of rounding f times the
 * condition of A, not of A'A. ICC_ERR_SOLVER when that does not get below 1e-6. Adds to `info`
 * (work, seconds_*). */
icc_status iccp_energy_minimise(const iccp_sparse *a, const iccp_reduction *reduction, double *f,
                                icc_function_info *info, const iccp_env *env);

#endif
