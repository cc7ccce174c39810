/* Constrained Delaunay triangulation of a simple polygon with points inside, or of walls.
 *
 * Words of this folder. Begin with this file, then trimesh.h and planar.h.
 * - corner: a vertex of one triangle, number 3 t + k. It faces the opposite edge, which is
 *   half-edge 3 t + k.
 * - twin, neighbour: the corner that faces the same edge from the other triangle.
 * - ghost: a vertex at infinity, which gives every edge of the hull a second triangle (trimesh.h).
 * - wall: a segment that the triangulation must contain (walls.h).
 * - chord: an edge between two boundary vertices that is not on the boundary.
 * - mesh of a domain: a triangulation of a polygon with graded inner points (planar.h, grading.h).
 * - finder: a grid that finds the triangle of a point (finder.h).
 * - legalise: to flip edges until they are Delaunay.
 *
 * Ways: triangulate.c takes delaunay.h (in the order of insertion_order.h), then constrain.h for
 * the walls, and drops what is outside. planar.h meshes a domain, with the points of grading.h.
 * corners.h cuts and flips edges of a mesh, finder.h finds triangles, laplacian.h has equations.
 * vertex_fans.h turns around vertices where a boundary touches itself.
 *
 * Invariants: all triangles are counter-clockwise, by exact signs. The same points give the same
 * triangulation on every machine. */
#ifndef ICCP_TRIANGULATE_H
#define ICCP_TRIANGULATE_H

#include "base/env.h"
#include "icc/stages.h"
#include "mesh/walls.h"

/* Stands for the neighbour beyond an edge of the polygon. */
#define ICCP_NO_NEIGHBOUR UINT32_MAX

/* See icc_triangulate(). The points are local (geometry/frame.h), with non-zero magnitudes in
 * [2^-200, 2^200]. There are at most ICCP_TRIMESH_MAX_POINTS (2^28).
 *
 * Returns ICC_ERR_BOUNDARY if the polygon is not simple. Returns ICC_ERR_OUTSIDE if the point
 * `index` lies outside or on the polygon, and ICC_ERR_ARGUMENT if it repeats another inner
 * point. */
icc_status iccp_triangulate(size_t n_boundary, size_t n_points, const double *points,
                            uint32_t *triangles, const iccp_env *env, icc_error *err);

/* Like iccp_triangulate(), and also writes neighbours. The neighbour of corner 3 t + k, number k of
 * triangle t, is the corner that faces the same edge from the other side, or ICCP_NO_NEIGHBOUR.
 * `neighbours` has the size of `triangles`, or is NULL. */
icc_status iccp_triangulate_mesh(size_t n_boundary, size_t n_points, const double *points,
                                 uint32_t *triangles, uint32_t *neighbours, const iccp_env *env,
                                 icc_error *err);

/* Writes the part of a triangulation that lies inside the bounds, which are some of its walls. A
 * place is inside if a way from outside crosses an odd number of bounds. Other walls may close
 * rings inside the part, and the part may have several pieces. Neighbours are as above, across
 * walls if both sides belong to the part. Both arrays have room for 6 n_points, of which 3
 * *n_triangles are used in the end.
 *
 * Returns ICC_ERR_BOUNDARY, ICC_ERR_OUTSIDE or ICC_ERR_ARGUMENT if walls cross, or if points lie on
 * walls or are equal. Returns ICC_ERR_TOPOLOGY if bounds do not close. */
icc_status iccp_triangulate_walls(size_t n_points, const double *points, const iccp_walls *walls,
                                  const iccp_walls *bounds, uint32_t *triangles,
                                  uint32_t *neighbours, size_t *n_triangles, const iccp_env *env);

#endif
