/* Conjugate gradients for the step of Newton's method, ended early. */
#ifndef ICCP_TRUNCATED_CG_H
#define ICCP_TRUNCATED_CG_H

#include "base/env.h"
#include "math/symmetric.h"

/* Doubles of work space per unknown: the residual, the preconditioned one, a direction and its
 * product, and the factors of its block. */
enum { ICCP_TRUNCATED_CG_WORK = 6 };

/* Sets `step` to about -H^-1 gradient, a direction of descent: ends when the residual, in the
 * preconditioner's norm, has fallen to the share `residual`. The unknowns come in threes, with
 * their own block of the Hessian H first in each row. `work`: ICCP_TRUNCATED_CG_WORK for each
 * unknown. ICC_OK, or ICC_ERR_CANCELLED; `stage` is for the progress. */
icc_status iccp_truncated_cg(const iccp_symmetric *hessian, const double *gradient, double *step,
                             double residual, double *work, const char *stage, const iccp_env *env);

#endif
