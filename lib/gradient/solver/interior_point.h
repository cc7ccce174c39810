/* Interior point method for the quadratic program of qp.h. */
#ifndef ICCP_INTERIOR_POINT_H
#define ICCP_INTERIOR_POINT_H

#include "gradient/solver/newton_qp.h"
#include "gradient/solver/solution.h"

typedef struct iccp_interior_point {
    iccp_newton_qp newton;
    size_t n_iterations;
    /* Share of the first iterate's residuals; each step reduces it by its length */
    double remaining;
} iccp_interior_point;

/* Analyses the systems and finds a starting point. For memory see newton_qp.h. */
icc_status iccp_interior_point_create(iccp_interior_point *ip, const iccp_qp *qp,
                                      iccp_solution *info, const iccp_env *env);
void iccp_interior_point_free(iccp_interior_point *ip);

/* Iterates until the mean of slack * multiplier is below `target`. *stuck: rounding errors prevent
 * that, and the iterate is the last good one. Adds to `info` (work, seconds_*). */
icc_status iccp_interior_point_run(iccp_interior_point *ip, double target, bool *stuck,
                                   iccp_solution *info, const iccp_env *env);

#endif
