/* Forcing the edges of a polygon, or other segments, into a triangulation. */
#ifndef ICCP_CONSTRAIN_H
#define ICCP_CONSTRAIN_H

#include "mesh/trimesh.h"

/* Makes a Delaunay triangulation of the points the one constrained by their polygon or walls, which
 * no longer flip. ICC_ERR_BOUNDARY when two of them cross or one of the polygon's vertices lies on
 * one, ICC_ERR_OUTSIDE when another point does; ICC_ERR_MEMORY, ICC_ERR_CANCELLED. */
icc_status iccp_constrain(iccp_trimesh *mesh, const iccp_env *env, icc_error *err);

#endif
