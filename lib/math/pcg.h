/* Conjugate gradients with a symmetric Gauss-Seidel preconditioner. */
#ifndef ICCP_PCG_H
#define ICCP_PCG_H

#include "base/env.h"
#include "math/symmetric.h"

/* Doubles of work space per unknown. */
enum { ICCP_PCG_WORK = 5 };

/* Adds to z what else shall precondition: a symmetric matrix without negative eigenvalues, times
 * r. */
typedef icc_status (*iccp_pcg_part)(void *argument, const double *r, double *z);

/* Solves for b, replaced by the solution; `part` may be NULL. Iterates until the residual is 1e-13
 * of the right-hand side or no longer falls; ICC_ERR_SOLVER when it then is above 1e-9, or a
 * direction shows before that the matrix is not positive definite. `work`: ICCP_PCG_WORK * n
 * doubles. */
icc_status iccp_pcg_solve(const iccp_symmetric *matrix, iccp_pcg_part part, void *argument,
                          double *b, double *work, const iccp_env *env);

#endif
