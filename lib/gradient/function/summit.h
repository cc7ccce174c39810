/* Where a plate is highest that is loaded there. */
#ifndef ICCP_SUMMIT_H
#define ICCP_SUMMIT_H

#include "gradient/function/function.h"

/* Finds a root that the function has its greatest value at: from function->info.highest, moves the
 * load to the greatest value until it stays. `function` is ICC_FUNCTION_BILAPLACE or
 * ICC_FUNCTION_CLAMPED without inequalities. One factorisation, then one solution a move, or two;
 * gives up after 1,000 solutions, and `summit` is where they have led. */
icc_status iccp_function_summit(const icc_function *function, uint32_t *summit,
                                const iccp_env *env);

#endif
