/* The quadratic program of qp.h on large grids: from coarse to fine. */
#ifndef ICCP_NESTED_H
#define ICCP_NESTED_H

#include "gradient/solver/smoothing.h"

/* An iterate on the grid of `qp`. */
typedef struct iccp_nested {
    iccp_newton_qp newton;
    iccp_smoothing smoothing;
} iccp_nested;

/* Solves on coarser grids, down to one of at most `coarsest` unknowns, each one's solution being
 * the guess for the next. *useful: false when the next coarser grid does not hold the shape any
 * more; there is nothing to run or to free then. Adds to `info` (n_iterations, work, seconds_*).
 * Memory: that of iccp_newton_qp_create(), and a third of all that besides. On failure nothing is
 * left allocated. */
icc_status iccp_nested_create(iccp_nested *nested, bool *useful, const iccp_qp *qp,
                              int32_t function, size_t coarsest, icc_function_info *info,
                              const iccp_env *env);
void iccp_nested_free(iccp_nested *nested);

#endif
