/* Critical points of a piecewise linear function on the Kuhn triangulation of a grid. */
#ifndef ICCP_CRITICAL_POINTS_H
#define ICCP_CRITICAL_POINTS_H

#include "gradient/function/function.h"

#include <stdbool.h>

/* See icc_function_get_report(). Only inside vertices with a value are judged. Outside vertices
 * count as lower, whatever their value. Fills in everything except `size`. ICC_ERR_MEMORY and
 * ICC_ERR_CANCELLED leave the report unchanged. */
icc_status iccp_function_verify(const icc_function *function, icc_function_report *report,
                                const iccp_env *env);

/* Tests whether there are no more critical points than the shape requires: a maximum at the root,
 * no minimum, and no saddle, except those of holes in 2-D. (The indices of the critical points add
 * up to the Euler characteristic. So with one maximum and no minimum, the saddles are those of the
 * holes.) */
icc_status iccp_function_is_regular(const icc_function *function, bool *regular,
                                    const iccp_env *env);

/* Returns a neighbour inside, in the Kuhn triangulation, that is higher than a vertex. ICCP_NONE if
 * there is none. */
uint32_t iccp_function_above(const icc_function *function, uint32_t vertex);

#endif
