/* Extrapolates functions that solve an equation to the vertices outside. */
#ifndef ICCP_EXTRAPOLATE_H
#define ICCP_EXTRAPOLATE_H

#include "gradient/function/function.h"

/* Sets the values outside from those inside. The values inside, with exponents if the function has
 * these, and the zeros outside must be set. If unknowns->reach says that the function is 0 before
 * the outside vertices, it first extrapolates to these. Then it fills in the layer of vertices
 * behind them. */
icc_status iccp_function_extrapolate(icc_function *function, const iccp_unknowns *unknowns);

/* Sets the value of an outside vertex behind one that is next to the inside: linearly from there.
 * Has no effect on other vertices. */
void iccp_function_extend_line(icc_function *function, uint32_t vertex);

#endif
