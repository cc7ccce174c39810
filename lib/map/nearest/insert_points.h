/* Inserts vertices into a one-to-one plane map. */
#ifndef ICCP_INSERT_POINTS_H
#define ICCP_INSERT_POINTS_H

#include "map/compatible/plmap.h"

/* Returns true if a flip of the edge that a corner faces makes the mesh more like a Delaunay mesh
 * of the source, keeps both triangles positive before and after the map, and shrinks neither much
 * more than the one that shrinks more now. The new edge must not join two held vertices, because a
 * triangle of three of them could not be improved. */
bool iccp_may_flip_to_delaunay(const iccp_plmap *map, uint32_t corner);

/* Inserts n points, one after another, at the images that the map gives them. The mesh becomes
 * nearly Delaunay in the source. All triangles of the map must be positive before and after it, and
 * stay so. Vertex number[i] of the map is then at point i. That is a new vertex, unless the map had
 * one there. *is_done is false if rounding spoils a triangle. Then the map is of no use. Expected
 * time O(n log n). */
icc_status iccp_insert_points(iccp_plmap *map, size_t n, const double *points, uint32_t *number,
                              bool *is_done, const iccp_env *env);

#endif
