/* Values for vertices outside that walks meet and no tree reaches. */
#ifndef ICCP_GRADIENT_BOUNDARY_H
#define ICCP_GRADIENT_BOUNDARY_H

#include "gradient/function/function.h"

/* A tree has two layers of vertices outside, and a simplex with a vertex inside may have others up
 * to dim steps away from it. Their values continue linearly from the last two layers. Has no effect
 * in the plane. */
icc_status iccp_gradient_extend(icc_function *field, const iccp_env *env);

#endif
