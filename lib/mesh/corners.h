/* Local changes of a triangle mesh that consists of two arrays: the vertex of each corner, and its
 * twin. The twin is the corner that faces the same edge from the other side (ICCP_NO_NEIGHBOUR on
 * the boundary). Numbering as in mesh/trimesh.h. */
#ifndef ICCP_CORNERS_H
#define ICCP_CORNERS_H

#include "mesh/triangulate.h"
#include "mesh/trimesh.h"

typedef struct iccp_corners {
    uint32_t *vertex, *twin; /* by corner, 3 per triangle */
    size_t n_triangles;
} iccp_corners;

/* Puts vertex m on the edge that a corner faces, and cuts the triangles beside it in two. Two
 * triangles are added at the end, or one for a boundary edge. */
void iccp_cut_edge(iccp_corners *corners, uint32_t corner, uint32_t m);

/* Cuts a triangle into three around vertex m. Two triangles are added at the end. The last corner
 * of each of the three is at m. */
void iccp_cut_triangle(iccp_corners *corners, uint32_t triangle, uint32_t m);

/* Flips an inner edge: replaces it by the other diagonal of its two triangles. */
void iccp_flip_edge(iccp_corners *corners, uint32_t corner);

/* Merges the vertex of a corner into the vertex after it. No edge at the vertex may be on the
 * boundary. The corner's triangle and the one beside that edge become unused: nothing refers to
 * them any more. The caller makes sure that no edge appears twice. */
void iccp_collapse_edge(iccp_corners *corners, uint32_t corner);

/* Finds the twins of the corners of triangles from their vertices, which are smaller than
 * n_vertices. All triangles must be counter-clockwise. *is_manifold becomes false if an edge
 * belongs to two triangles on the same side, or if a triangle contains a vertex twice. Then
 * `corners->twin` is undefined. O(n). */
icc_status iccp_find_twins(iccp_corners *corners, size_t n_vertices, bool *is_manifold,
                           const iccp_env *env);

/* Sets next[v] to the vertex after v along the boundary, with the inside on the left, or to
 * UINT32_MAX if v lies inside. Returns false if a vertex is followed by two. */
bool iccp_link_boundary(const iccp_corners *corners, size_t n_vertices, uint32_t *next);

#endif
