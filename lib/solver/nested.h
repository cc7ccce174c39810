/* The quadratic program of qp.h on large grids: from coarse to fine. */
#ifndef ICCP_NESTED_H
#define ICCP_NESTED_H

#include "solver/polish.h"

/* Solves on coarser grids first, down to one of at most `coarsest` unknowns, each one's solution
 * being the guess for the next, and replaces the candidate by what it finds. `active`: for
 * iccp_polish() to go on from. When the next coarser grid does not hold the shape any more, the
 * candidate stays as it is. Adds to `info` (n_iterations, work, seconds_*). Memory: that of
 * iccp_newton_qp_create(), and a third of all that besides. */
icc_status iccp_nested(const iccp_qp *qp, int32_t function, size_t coarsest, double enough,
                       iccp_candidate *candidate, uint8_t *active, icc_function_info *info,
                       const iccp_env *env);

#endif
