/* Active set iteration for the quadratic program of qp.h, from a good guess. */
#ifndef ICCP_POLISH_H
#define ICCP_POLISH_H

#include "gradient/solver/qp.h"
#include "gradient/solver/solution.h"

/* Steps in a row that find nothing better, after which a method ends. */
enum { ICCP_QP_PATIENCE = 20 };

/* A function, and how far it is from the solution. */
typedef struct iccp_candidate {
    double *f;       /* by unknown; f_0 = 1 */
    double residual; /* see iccp_inequalities_residual(); HUGE_VAL: nothing found yet */
} iccp_candidate;

/* Solves with the inequalities for which active[i] != 0 as equations, and corrects this set, which
 * is overwritten. Ends when nothing is wrong by more than `enough`, or when several corrections in
 * a row have not helped. `by_rows` says that only the ends of rows of active inequalities are
 * wrong, so they may be corrected a row at a time. Replaces the candidate by any better one. Adds
 * to `info` (n_iterations, work, seconds_*). */
icc_status iccp_polish(const iccp_qp *qp, uint8_t *active, bool by_rows, double enough,
                       iccp_candidate *candidate, iccp_solution *info, const iccp_env *env);

#endif
