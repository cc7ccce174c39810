/* Solves the quadratic program of qp.h on large grids, from coarse to fine. */
#ifndef ICCP_NESTED_H
#define ICCP_NESTED_H

#include "gradient/solver/smoothing.h"
#include "gradient/solver/solution.h"

/* Residual at which smoothing has found most active inequalities. On letters C of 117,000 to
 * 468,000 unknowns that takes 16 to 30 iterations. A finer grid loses any further digits. */
#define ICCP_NESTED_ENOUGH 1e-8

/* An iterate on the grid of `qp`. */
typedef struct iccp_nested {
    iccp_newton_qp newton;
    iccp_smoothing smoothing;
} iccp_nested;

/* Solves on coarser grids, down to one of at most `coarsest` unknowns. Each solution is the guess
 * for the next grid. *useful becomes false if the next coarser grid no longer represents the shape;
 * then there is nothing to run or to free. Adds to `info` (n_iterations, work, seconds_*). Needs
 * the memory of iccp_newton_qp_create(), plus a third of that. On failure nothing stays
 * allocated. */
icc_status iccp_nested_create(iccp_nested *nested, bool *useful, const iccp_qp *qp,
                              int32_t function, size_t coarsest, iccp_solution *info,
                              const iccp_env *env);
void iccp_nested_free(iccp_nested *nested);

#endif
