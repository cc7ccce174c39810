/* Smoothing method for the quadratic program of qp.h, from a guess. */
#ifndef ICCP_SMOOTHING_H
#define ICCP_SMOOTHING_H

#include "gradient/solver/newton_qp.h"
#include "gradient/solver/polish.h"

/* An iterate, from f and multiplier of `newton`, of which the latter may be 0. `newton` belongs to
 * the caller, and must live longer. */
typedef struct iccp_smoothing {
    iccp_newton_qp *newton;
    size_t n, m; /* unknowns, inequalities */
    double unit, width;
    double *size; /* per unknown: of f in the beginning, the bound at least */
    double *v;    /* per inequality: see smoothing.c */
} iccp_smoothing;

icc_status iccp_smoothing_create(iccp_smoothing *smoothing, iccp_newton_qp *newton,
                                 const iccp_env *env);
void iccp_smoothing_free(iccp_smoothing *smoothing);

/* Iterates until the residual is at most `enough` or does not get smaller any more; may be called
 * again, to go on. The iterate of `newton` is the last one, with positive slacks and multipliers;
 * the candidate is replaced by what is better than it. active[i]: which of inequality i's slack and
 * multiplier is the smaller one, in its own unit. Adds to `info` (n_iterations, seconds_*). */
icc_status iccp_smoothing_run(iccp_smoothing *smoothing, double enough, iccp_candidate *candidate,
                              uint8_t *active, icc_function_info *info, const iccp_env *env);

#endif
