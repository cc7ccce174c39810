/* State and linear systems of the methods for the quadratic program of qp.h that keep slacks and
 * multipliers positive. */
#ifndef ICCP_NEWTON_QP_H
#define ICCP_NEWTON_QP_H

#include "gradient/solver/qp.h"
#include "gradient/solver/solution.h"
#include "math/ldlt.h"

/* Progress reports count this many iterations of either method as half of the work. */
#define ICCP_NEWTON_TYPICAL 15.0

typedef struct iccp_newton_qp {
    iccp_memory memory;
    const iccp_qp *qp;          /* borrowed */
    double *f;                  /* by unknown; f_0 = 1 */
    double *slack, *multiplier; /* by inequality; positive */
    double softness;            /* see newton_qp.c */
    iccp_sparse b;              /* A above G, without the root's column */
    iccp_gram gram;
    iccp_ldlt factor;
    double *weight;        /* by row of b */
    double *dual, *primal; /* residuals: by unknown, by inequality */
    double *product;       /* by inequality: slack * multiplier, minus the goal */
    double *step_f, *step_slack, *step_multiplier; /* like f, slack and multiplier */
    /* Right-hand sides, and workspace for the longest of these arrays and for 2 n doubles */
    double *force, *gap, *work;
    double *room; /* memory of all these arrays */
} iccp_newton_qp;

/* Analyses the systems. The caller then sets the iterate. Needs the memory of the factor, about 20
 * doubles per unknown and 12 per inequality. On failure nothing stays allocated. */
icc_status iccp_newton_qp_create(iccp_newton_qp *newton, const iccp_qp *qp, iccp_solution *info,
                                 const iccp_env *env);
void iccp_newton_qp_free(iccp_newton_qp *newton);

/* out = A'A f - G'y, except at the root, which does not move. */
void iccp_newton_qp_stationarity(const iccp_newton_qp *newton, const double *f, const double *y,
                                 double *out);

/* Sets `dual` and `primal` for the present iterate. */
void iccp_newton_qp_residuals(iccp_newton_qp *newton);

/* Factorises for the present slacks and multipliers. Returns ICC_ERR_SOLVER if the matrix is not
 * positive definite, however soft it becomes. */
icc_status iccp_newton_qp_factorise(iccp_newton_qp *newton, iccp_solution *info,
                                    const iccp_env *env);

/* Computes the step of the slacks, and the residuals of the two equations in `force` and `gap`.
 * Returns the largest gap in units of its slack. */
double iccp_newton_qp_errors(iccp_newton_qp *newton);

/* Solves the two equations for the right-hand sides `force` and `gap`, and adds the solution to the
 * step. */
void iccp_newton_qp_add_solution(iccp_newton_qp *newton);

#endif
