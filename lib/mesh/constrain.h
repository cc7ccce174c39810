/* Forcing the edges of a polygon into a triangulation. */
#ifndef ICCP_CONSTRAIN_H
#define ICCP_CONSTRAIN_H

#include "mesh/trimesh.h"

/* Makes a Delaunay triangulation of the points the one constrained by their polygon, whose edges no
 * longer flip. ICC_ERR_BOUNDARY when the polygon is not simple, ICC_ERR_OUTSIDE when another point
 * lies on it; ICC_ERR_MEMORY, ICC_ERR_CANCELLED. */
icc_status iccp_constrain(iccp_trimesh *mesh, const iccp_env *env, icc_error *err);

#endif
