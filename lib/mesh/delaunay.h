/* The Delaunay triangulation of points, without constraints. */
#ifndef ICCP_DELAUNAY_H
#define ICCP_DELAUNAY_H

#include "mesh/trimesh.h"

/* Triangulates the mesh's points, at least three, into its corners, which have enough room. For
 * cocircular points any Delaunay triangulation may result, but always the same one for the same
 * points.
 *
 * Returns ICC_ERR_BOUNDARY if all points lie on one line. If two are equal, returns
 * ICC_ERR_BOUNDARY if both are vertices of the polygon, ICC_ERR_OUTSIDE if one is, else
 * ICC_ERR_ARGUMENT. Other failures: ICC_ERR_MEMORY, ICC_ERR_CANCELLED. */
icc_status iccp_delaunay(iccp_trimesh *mesh, const iccp_env *env, icc_error *err);

#endif
