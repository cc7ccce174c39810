/* Conjugate gradients for a step of Newton's method, ended early. */
#ifndef ICCP_TRUNCATED_CG_H
#define ICCP_TRUNCATED_CG_H

#include "base/env.h"
#include "math/symmetric.h"

/* Doubles of work space per unknown: the residual, the preconditioned residual, a direction, its
 * product, and the factors of the block. */
enum { ICCP_TRUNCATED_CG_WORK = 6 };

/* Sets `step` to about -H^-1 gradient, a direction of descent. Ends when the residual, in the
 * preconditioner's norm, has fallen to the share `residual`. The unknowns come in threes, and each
 * row of the Hessian H starts with the point's own block. `work` has ICCP_TRUNCATED_CG_WORK doubles
 * for each unknown. Returns ICC_OK or ICC_ERR_CANCELLED. `stage` names the progress. */
icc_status iccp_truncated_cg(const iccp_symmetric *hessian, const double *gradient, double *step,
                             double residual, double *work, const char *stage, const iccp_env *env);

#endif
