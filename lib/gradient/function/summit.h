/* Moves the maximum of a bi-Laplace function to where its load is. */
#ifndef ICCP_SUMMIT_H
#define ICCP_SUMMIT_H

#include "gradient/function/function.h"

/* Finds a root at which the function has its greatest value. Starts from function->info.highest and
 * moves the load to the greatest value until it stays there. `function` is ICC_FUNCTION_BILAPLACE
 * or ICC_FUNCTION_CLAMPED without inequalities. Needs one factorisation, then one or two solutions
 * per move. After 1,000 solutions it stops, and `summit` is the last place of the load. */
icc_status iccp_function_summit(const icc_function *function, uint32_t *summit,
                                const iccp_env *env);

#endif
