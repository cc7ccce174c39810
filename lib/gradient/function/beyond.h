/* Values at the vertices outside of a function that solves an equation. */
#ifndef ICCP_BEYOND_H
#define ICCP_BEYOND_H

#include "gradient/function/function.h"

/* From the values inside, which are there, with exponents where the function has these, and zeros
 * outside: where unknowns->reach says that the function is 0 before the vertices outside, what lies
 * beyond; then the layer of vertices behind these. */
icc_status iccp_function_go_beyond(icc_function *function, const iccp_unknowns *unknowns);

#endif
