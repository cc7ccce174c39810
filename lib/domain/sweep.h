/* Whether a polygon is simple, in O(n log n). */
#ifndef ICCP_SWEEP_H
#define ICCP_SWEEP_H

#include "domain/defect.h"
#include "domain/polygon.h"

/* Looks for a defect of a polygon of at least 3 finite points; found->kind is 0 if there is none.
 * Which one is found of several says nothing. */
icc_status iccp_sweep(iccp_defect *found, const iccp_polygon *polygon, const iccp_env *env);

#endif
