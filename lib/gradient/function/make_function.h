/* Makes functions of all kinds. */
#ifndef ICCP_MAKE_FUNCTION_H
#define ICCP_MAKE_FUNCTION_H

#include "gradient/function/function.h"

/* See icc_function_create(). The options have been checked. Options that are zero are completed
 * here. */
icc_status iccp_function_create(icc_function **out, const icc_tree *tree,
                                const icc_function_options *options, const iccp_env *env,
                                icc_error *err);

#endif
