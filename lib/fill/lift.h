/* Lifts points that were put on the surface off it. */
#ifndef ICCP_LIFT_H
#define ICCP_LIFT_H

#include "fill/constraints.h"

/* Afterwards the walls are exactly the facets. All other points lie inside and are doubles. Returns
 * ICC_ERR_RESOLUTION and names a facet if a point cannot leave it. */
icc_status iccp_lift(iccp_tets *m, const iccp_constraints *s, const iccp_env *env, icc_error *err);

#endif
