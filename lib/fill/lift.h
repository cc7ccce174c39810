/* Points that were put on the surface leave it. */
#ifndef ICCP_LIFT_H
#define ICCP_LIFT_H

#include "fill/surface.h"

/* Afterwards the walls are the facets, whole, and all points but those of the surface lie inside
 * and are doubles. ICC_ERR_RESOLUTION naming a facet that a point cannot leave. */
icc_status iccp_lift(iccp_tets *m, const iccp_surface *s, const iccp_env *env, icc_error *err);

#endif
