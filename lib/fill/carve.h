/* Removes what is outside the surfaces, and separates what lies on both sides of inner surfaces. */
#ifndef ICCP_CARVE_H
#define ICCP_CARVE_H

#include "fill/constraints.h"

/* Removes all tetrahedra outside the surface and inside voids. Marks the faces on facets as walls:
 * on one side of the boundary, and on both sides of inner surfaces. A point on an inner surface
 * that is no vertex becomes two points, one for each side. */
icc_status iccp_carve(iccp_tets *m, const iccp_constraints *s, const iccp_env *env, icc_error *err);

#endif
