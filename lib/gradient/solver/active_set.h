/* Laplace's function under the tree's inequalities f_parent >= (1 + eta) f_child. */
#ifndef ICCP_ACTIVE_SET_H
#define ICCP_ACTIVE_SET_H

#include "gradient/solver/tied.h"

typedef icc_status (*iccp_tied_solver)(const iccp_unknowns *unknowns, const iccp_ties *ties,
                                       const iccp_scaled *f, icc_function_info *info,
                                       const iccp_env *env);

/* f: the solution without inequalities on entry, that with them on return, swept, so that none is
 * violated. `solve`: the back end, called once per iteration; `order`: as in iccp_ties, best from
 * the solution without. Fills in n_violated, n_active, n_iterations, residual_before, residual and
 * seconds_verify of `info`; the solver adds to the rest. ICC_ERR_SOLVER when the active set has not
 * settled after 1000 iterations. Memory: 30 bytes an unknown beside the solver's. */
icc_status iccp_active_set_laplace(const iccp_unknowns *unknowns, double eta,
                                   iccp_tied_solver solve, uint32_t *order, const iccp_scaled *f,
                                   icc_function_info *info, const iccp_env *env);

#endif
