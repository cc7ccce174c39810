/* What methods for the quadratic program of qp.h that keep slacks and multipliers positive have in
 * common: their state, and the linear systems of their steps. */
#ifndef ICCP_NEWTON_QP_H
#define ICCP_NEWTON_QP_H

#include "gradient/solver/qp.h"
#include "math/ldlt.h"

typedef struct iccp_newton_qp {
    iccp_memory memory;
    const iccp_qp *qp;          /* borrowed */
    double *f;                  /* per unknown; f_0 = 1 */
    double *slack, *multiplier; /* per inequality; positive */
    double softness;            /* see newton_qp.c */
    iccp_sparse b;              /* A above G, without the root's column */
    iccp_gram gram;
    iccp_ldlt factor;
    double *weight;        /* per row of b */
    double *dual, *primal; /* residuals: per unknown, per inequality */
    double *product;       /* per inequality: slack * multiplier, less what is wanted */
    double *step_f, *step_slack, *step_multiplier; /* as f, slack and multiplier */
    double *force, *gap, *work; /* right-hand sides, and room for the longest of all these and for
                                   2 n doubles */
    double *room;               /* what all these arrays lie in */
} iccp_newton_qp;

/* Analyses the systems; the iterate is for the caller to set. Memory: that of the factor, about 20
 * doubles per unknown and 12 per inequality. On failure nothing is left allocated. */
icc_status iccp_newton_qp_create(iccp_newton_qp *newton, const iccp_qp *qp, icc_function_info *info,
                                 const iccp_env *env);
void iccp_newton_qp_free(iccp_newton_qp *newton);

/* out = A'A f - G'y but for the root, which does not move. */
void iccp_newton_qp_stationarity(const iccp_newton_qp *newton, const double *f, const double *y,
                                 double *out);

/* Sets `dual` and `primal` for the present iterate. */
void iccp_newton_qp_residuals(iccp_newton_qp *newton);

/* For the present slacks and multipliers. ICC_ERR_SOLVER when the matrix is not positive definite
 * however soft it gets. */
icc_status iccp_newton_qp_factorise(iccp_newton_qp *newton, icc_function_info *info,
                                    const iccp_env *env);

/* What the step leaves of the two equations, into `force` and `gap`, and the step of the slacks;
 * returns the largest gap in units of its slack. */
double iccp_newton_qp_errors(iccp_newton_qp *newton);

/* Adds to the step what solves the two equations for the right sides `force` and `gap`. */
void iccp_newton_qp_add_solution(iccp_newton_qp *newton);

#endif
