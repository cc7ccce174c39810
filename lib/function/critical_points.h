/* Critical points of a piecewise linear function on the Kuhn triangulation of a grid. */
#ifndef ICCP_CRITICAL_POINTS_H
#define ICCP_CRITICAL_POINTS_H

#include "function/field.h"

#include <stdbool.h>

/* See icc_field_verify(). Only vertices inside that have a value are judged; vertices outside
 * count as lower than they are, whatever their value. Fills in everything but `size`;
 * ICC_ERR_MEMORY or ICC_ERR_CANCELLED leave the report as it was. */
icc_status iccp_field_verify(const icc_field *field, icc_field_report *report, const iccp_env *env);

/* Whether there are no more critical points than the shape asks for: a maximum at the root, no
 * minimum, and no saddle, but for those that 2-D shapes with holes cannot do without. (The indices
 * of the critical points add up to the Euler characteristic: with one maximum and no minimum, the
 * saddles are those of the holes.) */
icc_status iccp_field_is_regular(const icc_field *field, bool *regular, const iccp_env *env);

#endif
