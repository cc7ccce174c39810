/* Laplace and bi-Laplace functions, with and without the tree's inequalities. */
#ifndef ICCP_LAPLACE_H
#define ICCP_LAPLACE_H

#include "gradient/function/function.h"

/* Gives values to a new function of kind ICC_FUNCTION_LAPLACE, _BILAPLACE or _CLAMPED. See
 * icc_function_create(). */
icc_status iccp_laplace(icc_function *function, const icc_function_options *options,
                        const iccp_env *env, icc_error *err);

#endif
