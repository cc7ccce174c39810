/* Moves the maximum of a bi-Laplace function to where its load is. */
#ifndef ICCP_MOVE_MAXIMUM_H
#define ICCP_MOVE_MAXIMUM_H

#include "gradient/function/function.h"

/* Finds a root at which the function has its greatest value. Starts from function->info.highest and
 * moves the load to the greatest value until it stays there. `function` is ICC_FUNCTION_BILAPLACE
 * or ICC_FUNCTION_CLAMPED without inequalities. Needs one factorisation, then one or two solutions
 * per move. After 1,000 solutions it stops, and `maximum` is the last place of the load. */
icc_status iccp_function_move_maximum(const icc_function *function, uint32_t *maximum,
                                      const iccp_env *env);

#endif
