/* Functions of the caller's: values or logarithms at the vertices of a tree. */
#ifndef ICCP_GIVEN_FUNCTION_H
#define ICCP_GIVEN_FUNCTION_H

#include "gradient/function/function.h"

/* The largest size of a caller's value. Exact signs of products of differences need the rest. */
#define ICCP_MAX_VALUE 0x1p900

/* See icc_function_create_values(). The values inside are at most ICCP_MAX_VALUE in size, and those
 * outside are, too, or NaN. */
icc_status iccp_function_create_values(icc_function **out, const icc_tree *tree,
                                       const double *values, const iccp_env *env);

/* See icc_function_create_logs(). The logarithms inside are finite. */
icc_status iccp_function_create_logs(icc_function **out, const icc_tree *tree, const double *logs,
                                     const iccp_env *env);

/* Makes the same function from fractions and exponents, one of each per grid vertex. Those inside
 * are normalised and positive. */
icc_status iccp_function_create_scaled(icc_function **out, const icc_tree *tree,
                                       const iccp_scaled *given, const iccp_env *env);

#endif
