/* Gives values to outside vertices that walks meet and no tree reaches. */
#ifndef ICCP_GRADIENT_BOUNDARY_H
#define ICCP_GRADIENT_BOUNDARY_H

#include "gradient/function/function.h"

/* Extends a function linearly from its last two layers. A tree has two layers of outside vertices.
 * A simplex with an inside vertex may have others up to dim steps away from it. Has no effect in
 * the plane. */
icc_status iccp_gradient_extend(icc_function *field, const iccp_env *env);

#endif
