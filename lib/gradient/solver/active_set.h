/* Solves for Laplace's function under the tree's inequalities f_parent >= (1 + eta) f_child. */
#ifndef ICCP_ACTIVE_SET_H
#define ICCP_ACTIVE_SET_H

#include "gradient/solver/solution.h"
#include "gradient/solver/tied.h"

typedef icc_status (*iccp_tied_solver)(const iccp_unknowns *unknowns, const iccp_ties *ties,
                                       const iccp_scaled *f, iccp_solution *info,
                                       const iccp_env *env);

/* On entry f is the solution without inequalities. On return it is the solution with them, swept so
 * that none is violated. `solve` is the back end, called once per iteration. `order` is as in
 * iccp_ties, best from the solution without inequalities.
 *
 * Fills in n_violated, n_active, n_iterations, residual_before, residual and seconds_verify of
 * `info`; the solver adds to the rest. Returns ICC_ERR_SOLVER if the active set has not converged
 * after 1000 iterations. Needs 30 bytes per unknown besides the solver's memory. */
icc_status iccp_active_set_laplace(const iccp_unknowns *unknowns, double eta,
                                   iccp_tied_solver solve, uint32_t *order, const iccp_scaled *f,
                                   iccp_solution *info, const iccp_env *env);

#endif
