/* Equations with the caller's fixed values and right-hand side. */
#ifndef ICCP_GIVEN_EQUATION_H
#define ICCP_GIVEN_EQUATION_H

#include "gradient/function/function.h"

/* See icc_function_create_solve(). The function is ICC_FUNCTION_LAPLACE or _BILAPLACE. `fixed` has
 * no infinities, and `right_side` is finite at the free vertices. */
icc_status iccp_function_solve(icc_function **out, const icc_tree *tree, int32_t function,
                               const double *fixed, const double *right_side, const iccp_env *env);

#endif
