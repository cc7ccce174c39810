/* Interior point method for the quadratic program of qp.h. */
#ifndef ICCP_INTERIOR_POINT_H
#define ICCP_INTERIOR_POINT_H

#include "math/ldlt.h"
#include "solver/qp.h"

typedef struct iccp_interior_point {
    iccp_memory memory;
    const iccp_qp *qp;          /* borrowed */
    double *f;                  /* per unknown; f_0 = 1 */
    double *slack, *multiplier; /* per inequality; positive */
    size_t n_iterations;
    double remaining; /* share of the first iterate's residuals: each step takes its
                         length off */
    double softness;  /* see interior.c */
    iccp_sparse b;    /* A above G, without the root's column */
    iccp_gram gram;
    iccp_ldlt factor;
    double *weight;        /* per row of b */
    double *dual, *primal; /* residuals: per unknown, per inequality */
    double *product;       /* per inequality: slack * multiplier, less what is wanted */
    double *step_f, *step_slack, *step_multiplier; /* as f, slack and multiplier */
    double *force, *gap, *work; /* right-hand sides, and room for the longest of all these */
    double *room;               /* what all these arrays lie in */
} iccp_interior_point;

/* Analyses the systems and finds a point to start from. Memory: that of the factor, about 20
 * doubles per unknown and 12 per inequality. */
icc_status iccp_interior_point_create(iccp_interior_point *ip, const iccp_qp *qp,
                                      icc_function_info *info, const iccp_env *env);
void iccp_interior_point_free(iccp_interior_point *ip);

/* Half of the iterations, as far as progress goes. */
#define ICCP_INTERIOR_POINT_TYPICAL 15.0

/* Iterates until the mean of slack * multiplier is below `target`. *stuck: rounding errors do not
 * let it get there; the iterate is then the last good one. Adds to `info` (work, seconds_*). */
icc_status iccp_interior_point_run(iccp_interior_point *ip, double target, bool *stuck,
                                   icc_function_info *info, const iccp_env *env);

#endif
