/* Active set iteration for the quadratic program of qp.h, from a good guess. */
#ifndef ICCP_POLISH_H
#define ICCP_POLISH_H

#include "gradient/solver/qp.h"

/* Systems to solve at most when there is nothing else to try. */
#define ICCP_POLISH_MOST 1000

/* A function and how far it is from being the solution. */
typedef struct iccp_candidate {
    double *f;       /* per unknown; f_0 = 1 */
    double residual; /* see iccp_inequalities_residual(); HUGE_VAL: nothing found yet */
} iccp_candidate;

/* Solves with those inequalities as equations that have active[i] != 0, and corrects this set,
 * which is overwritten, until nothing is wrong by more than `enough`, several corrections in a row
 * have not helped, or `most` systems have been solved. `by_rows`: the set is right but for the ends
 * of rows of inequalities that are active together, which may be corrected a row at a time.
 * Replaces the candidate by what is better. Adds to `info` (n_iterations, work, seconds_*). */
icc_status iccp_polish(const iccp_qp *qp, uint8_t *active, bool by_rows, double enough, size_t most,
                       iccp_candidate *candidate, icc_function_info *info, const iccp_env *env);

#endif
