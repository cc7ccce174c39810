/* Functions of the generation alone. */
#ifndef ICCP_DISTANCE_H
#define ICCP_DISTANCE_H

#include "function/function.h"

/* Gives values to a new function: ICC_FUNCTION_DECAY or ICC_FUNCTION_DISTANCE. The decay would
 * underflow from some 13,850 generations on (cells = 16384 get there); from there on the values are
 * -1, -2, .., so that they always fall from one generation to the next. */
icc_status iccp_distance(icc_function *function, int32_t kind, const iccp_env *env);

#endif
