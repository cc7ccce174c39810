/* One step of Newton's method in the plane. */
#ifndef ICCP_NEWTON_STEP_H
#define ICCP_NEWTON_STEP_H

#include "base/minmax.h"
#include "math/vec.h"

/* Computes Newton's step, at most `most` long. The Hessian has the entries 00, 01, 11. If it is not
 * clearly positive, a multiple of the identity is added. */
static inline void iccp_newton_step(double step[2], const double gradient[2],
                                    const double hessian[3], double most)
{
    const double mean = 0.5 * (hessian[0] + hessian[2]);
    const double half = 0.5 * (hessian[0] - hessian[2]);
    const double radius = sqrt(half * half + hessian[1] * hessian[1]);
    const double more = iccp_max(0, 0.05 * (fabs(mean) + radius) - (mean - radius));
    const double a = hessian[0] + more, b = hessian[1], c = hessian[2] + more;
    const double det = a * c - b * b;
    step[0] = -(c * gradient[0] - b * gradient[1]) / det;
    step[1] = -(a * gradient[1] - b * gradient[0]) / det;
    const double length = iccp_vec_norm(2, step);
    if (length > most)
        for (int k = 0; k < 2; ++k)
            step[k] *= most / length;
}

#endif
