/* The Delaunay triangulation of points, without constraints. */
#ifndef ICCP_DELAUNAY_H
#define ICCP_DELAUNAY_H

#include "mesh/trimesh.h"

/* Triangulates the mesh's points, at least three, into its corners, which have the room that they
 * need. Of cocircular points any triangulation may result, always the same for the same points.
 *
 * ICC_ERR_BOUNDARY when all lie on one line. When two are equal: ICC_ERR_BOUNDARY if both are
 * vertices of the polygon, ICC_ERR_OUTSIDE if one is, else ICC_ERR_ARGUMENT. ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. */
icc_status iccp_delaunay(iccp_trimesh *mesh, const iccp_env *env, icc_error *err);

#endif
