/* Critical points of a piecewise linear function on the Kuhn triangulation of a grid. */
#ifndef ICCP_CRITICAL_POINTS_H
#define ICCP_CRITICAL_POINTS_H

#include "gradient/function/function.h"

#include <stdbool.h>

/* See icc_function_get_report(). Only vertices inside that have a value are judged; vertices
 * outside count as lower than they are, whatever their value. Fills in everything but `size`;
 * ICC_ERR_MEMORY or ICC_ERR_CANCELLED leave the report as it was. */
icc_status iccp_function_verify(const icc_function *function, icc_function_report *report,
                                const iccp_env *env);

/* Whether there are no more critical points than the shape asks for: a maximum at the root, no
 * minimum, and no saddle, but for those that 2-D shapes with holes cannot do without. (The indices
 * of the critical points add up to the Euler characteristic: with one maximum and no minimum, the
 * saddles are those of the holes.) */
icc_status iccp_function_is_regular(const icc_function *function, bool *regular,
                                    const iccp_env *env);

#endif
