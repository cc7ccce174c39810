/* Constrained Delaunay triangulation of a simple polygon with points inside, or of walls. */
#ifndef ICCP_TRIANGULATE_H
#define ICCP_TRIANGULATE_H

#include "base/env.h"
#include "icc/stages.h"
#include "mesh/walls.h"

/* Stands for the neighbour beyond an edge of the polygon. */
#define ICCP_NO_NEIGHBOUR UINT32_MAX

/* See icc_triangulate(); the points are local (geometry/frame.h), their non-zero magnitudes in
 * [2^-200, 2^200]; at most ICCP_TRIMESH_MAX_POINTS (2^28) of them.
 *
 * ICC_ERR_BOUNDARY: the polygon is not simple. ICC_ERR_OUTSIDE: the point `index` lies outside the
 * polygon or on it. ICC_ERR_ARGUMENT: it repeats another point inside. */
icc_status iccp_triangulate(size_t n_boundary, size_t n_points, const double *points,
                            uint32_t *triangles, const iccp_env *env, icc_error *err);

/* The same, and for each corner (number k of triangle t is 3 t + k) the corner that faces the same
 * edge from the other side, or ICCP_NO_NEIGHBOUR. `neighbours` has the room of `triangles`, or is
 * NULL. */
icc_status iccp_triangulate_mesh(size_t n_boundary, size_t n_points, const double *points,
                                 uint32_t *triangles, uint32_t *neighbours, const iccp_env *env,
                                 icc_error *err);

/* The part of the triangulation constrained by walls that can be reached from the left of the wall
 * from vertex `from` to vertex `to` without crossing a wall. Neighbours as above, across walls
 * where both sides belong to that part; both arrays have room for 6 n_points, of which 3
 * *n_triangles are used in the end.
 *
 * ICC_ERR_BOUNDARY, ICC_ERR_OUTSIDE or ICC_ERR_ARGUMENT when walls cross, points lie on them or are
 * equal; ICC_ERR_TOPOLOGY when rings do not close. */
icc_status iccp_triangulate_walls(size_t n_points, const double *points, const iccp_walls *walls,
                                  uint32_t from, uint32_t to, uint32_t *triangles,
                                  uint32_t *neighbours, size_t *n_triangles, const iccp_env *env);

#endif
