/* Values for vertices outside that walks meet and no tree reaches. */
#ifndef ICCP_GRADIENT_RIM_H
#define ICCP_GRADIENT_RIM_H

#include "function/function.h"

/* A tree has two layers of vertices outside, and a simplex with a vertex inside may have others up
 * to dim steps away from it. Their values go on as they do from the layer before the last to the
 * last. Has no effect in the plane. */
icc_status iccp_gradient_extend(icc_function *field, const iccp_env *env);

#endif
