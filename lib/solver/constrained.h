/* Laplace's function under the tree's inequalities f_parent >= (1 + eta) f_child. */
#ifndef ICCP_CONSTRAINED_H
#define ICCP_CONSTRAINED_H

#include "solver/glued.h"

typedef icc_status (*iccp_glued_solver)(const iccp_rows *rows, const iccp_gluing *gluing,
                                        const iccp_scaled *f, icc_function_info *info,
                                        const iccp_env *env);

/* f: the solution without inequalities on entry, that with them on return, swept, so that none is
 * violated. `solve`: the back end, called once per iteration; `order`: as in iccp_gluing, best from
 * the solution without. Fills in n_violated, n_active, n_iterations, residual_before, residual and
 * seconds_verify of `info`; the solver adds to the rest. ICC_ERR_SOLVER when the active set has not
 * settled after 1000 iterations. Memory: 30 bytes a row beside the solver's. */
icc_status iccp_constrained_laplace(const iccp_rows *rows, double eta, iccp_glued_solver solve,
                                    uint32_t *order, const iccp_scaled *f, icc_function_info *info,
                                    const iccp_env *env);

#endif
