/* Conjugate gradients with a symmetric Gauss-Seidel preconditioner. */
#ifndef ICCP_PCG_H
#define ICCP_PCG_H

#include "base/env.h"
#include "math/symmetric.h"

/* Doubles of workspace per unknown. */
enum { ICCP_PCG_WORK = 5 };

/* An additional preconditioner: adds to z a symmetric matrix without negative eigenvalues, times
 * r. */
typedef icc_status (*iccp_pcg_part)(void *argument, const double *r, double *z);

/* Solves for b, which is replaced by the solution. `part` may be NULL. Iterates until the residual
 * is 1e-13 of the right-hand side or no longer falls. Returns ICC_ERR_SOLVER if it is above 1e-9
 * then, or if a search direction shows that the matrix is not positive definite. `work` has
 * ICCP_PCG_WORK * n doubles. */
icc_status iccp_pcg_solve(const iccp_symmetric *matrix, iccp_pcg_part part, void *argument,
                          double *b, double *work, const iccp_env *env);

#endif
