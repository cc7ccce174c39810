/* Smoothing method for the quadratic program of qp.h, from a guess. */
#ifndef ICCP_SMOOTHING_H
#define ICCP_SMOOTHING_H

#include "solver/newton_qp.h"
#include "solver/polish.h"

/* Iterates from f and multiplier of `newton`, of which the latter may be 0, until the residual is
 * at most `enough` or does not get smaller any more. The iterate is the last one, with positive
 * slacks and multipliers; the candidate is replaced by what is better than it. active[i]: which of
 * inequality i's slack and multiplier is the smaller one, in its own unit. Adds to `info`
 * (n_iterations, seconds_*). */
icc_status iccp_smoothing(iccp_newton_qp *newton, double enough, iccp_candidate *candidate,
                          uint8_t *active, icc_function_info *info, const iccp_env *env);

#endif
