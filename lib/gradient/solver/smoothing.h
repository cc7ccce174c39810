/* Smoothing method for the quadratic program of qp.h, from a guess. */
#ifndef ICCP_SMOOTHING_H
#define ICCP_SMOOTHING_H

#include "gradient/solver/newton_qp.h"
#include "gradient/solver/polish.h"
#include "gradient/solver/solution.h"

/* An iterate. It starts from f and multiplier of `newton`; the latter may be 0. `newton` belongs to
 * the caller and must live longer. */
typedef struct iccp_smoothing {
    iccp_newton_qp *newton;
    size_t n, m; /* numbers of unknowns and inequalities */
    double unit, width;
    double *size; /* by unknown: initial f, at least the bound */
    double *v;    /* by inequality: see smoothing.c */
} iccp_smoothing;

icc_status iccp_smoothing_create(iccp_smoothing *smoothing, iccp_newton_qp *newton,
                                 const iccp_env *env);
void iccp_smoothing_free(iccp_smoothing *smoothing);

/* Iterates until the residual is at most `enough` or no longer falls. It may be called again to
 * continue. The iterate of `newton` is the last one, with positive slacks and multipliers. The
 * candidate is replaced by any better one. active[i] tells whether the slack or the multiplier of
 * inequality i is smaller, in its own unit. Adds to `info` (n_iterations, seconds_*). */
icc_status iccp_smoothing_run(iccp_smoothing *smoothing, double enough, iccp_candidate *candidate,
                              uint8_t *active, iccp_solution *info, const iccp_env *env);

#endif
