/* Forces the edges of a polygon, or other segments, into a triangulation. */
#ifndef ICCP_CONSTRAIN_H
#define ICCP_CONSTRAIN_H

#include "mesh/trimesh.h"

/* Turns a Delaunay triangulation of the points into the constrained one that contains their polygon
 * or walls. These edges no longer flip. Returns ICC_ERR_BOUNDARY if two of them cross or a vertex
 * of the polygon lies on one. Returns ICC_ERR_OUTSIDE if another point lies on one. Other failures:
 * ICC_ERR_MEMORY, ICC_ERR_CANCELLED. */
icc_status iccp_constrain(iccp_trimesh *mesh, const iccp_env *env, icc_error *err);

#endif
