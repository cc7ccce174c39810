/* Checks of triangles that a caller gives. Each function returns ICC_ERR_BOUNDARY, with a message,
 * if they are not a mesh. */
#ifndef ICCP_GIVEN_TRIANGLES_H
#define ICCP_GIVEN_TRIANGLES_H

#include "base/env.h"
#include "mesh/corners.h"

/* Copies n triangles and turns them counter-clockwise. Each must have area, and vertices below
 * n_vertices. `points` are local coordinates. */
icc_status iccp_orient_triangles(uint32_t *to, size_t n, const uint32_t *triangles,
                                 size_t n_vertices, const double *points, icc_error *err);

/* Checks that every vertex belongs to a triangle. */
icc_status iccp_check_used(size_t n_vertices, size_t n, const uint32_t *triangles,
                           const iccp_env *env, icc_error *err);

/* Finds the twins, and next[v] as iccp_link_boundary() does. The triangles must form a manifold,
 * so no two parts of the boundary may share a vertex. Returns ICC_ERR_TOPOLOGY if they are not in
 * one piece. */
icc_status iccp_link_triangles(iccp_corners *corners, size_t n_vertices, uint32_t *next,
                               const iccp_env *env, icc_error *err);

#endif
