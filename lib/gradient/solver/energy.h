/* The bending energy 1/2 |A f|^2 of functions on the unknowns, where A f is their Laplacian. Finds
 * its minimum under fixed and tied values. */
#ifndef ICCP_ENERGY_H
#define ICCP_ENERGY_H

#include "gradient/solver/solution.h"
#include "gradient/solver/unknowns.h"
#include "icc/stages.h"
#include "math/gram.h"

/* Makes A. For ICC_FUNCTION_LAPLACE it has one row for each pair of neighbours, with the
 * difference of their values, so that A'A is the Laplacian. Otherwise it has one row for the
 * Laplacian at each inside vertex, in the order of `unknowns`. For ICC_FUNCTION_CLAMPED, rows
 * follow for the vertices outside next to them, in the grid or not. There is one column per inside
 * vertex, and f is 0 outside. */
icc_status iccp_energy_create(iccp_sparse *a, const iccp_unknowns *unknowns, int32_t function,
                              const iccp_env *env);

/* out = A'A f. `work` has a->n_rows doubles. Computing A f first keeps digits that A'A would
 * lose. */
void iccp_energy_gradient(const iccp_sparse *a, const double *f, double *work, double *out);

/* f_k = share_k x_variable(k). If variable(k) is ICCP_NONE, f_k keeps its value. */
typedef struct iccp_reduction {
    size_t n_variables;
    const uint32_t *variable; /* by unknown: its free variable, or ICCP_NONE */
    const double *share;      /* > 0 if there is a variable */
} iccp_reduction;

/* Finds the least energy, minus force'f unless `force` is NULL, among such f. On entry f has the
 * known values, on return all values. It is refined until nothing improves. So the error is about
 * that of rounding f times the condition number of A, not of A'A. Returns ICC_ERR_SOLVER if the
 * error stays above 1e-6. Adds to `info` (work, seconds_*). */
icc_status iccp_energy_minimise(const iccp_sparse *a, const iccp_reduction *reduction,
                                const double *force, double *f, iccp_solution *info,
                                const iccp_env *env);

#endif
