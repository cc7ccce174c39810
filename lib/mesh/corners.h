/* Local changes of a triangle mesh given by two arrays: the vertex of each corner, and the corner
 * that faces the same edge from the other side (ICCP_NO_NEIGHBOUR on the boundary). Numbering as in
 * mesh/trimesh.h. */
#ifndef ICCP_CORNERS_H
#define ICCP_CORNERS_H

#include "mesh/triangulate.h"
#include "mesh/trimesh.h"

typedef struct iccp_corners {
    uint32_t *vertex, *twin; /* of each corner, 3 a triangle */
    size_t n_triangles;
} iccp_corners;

/* Puts vertex m on the edge that a corner faces and cuts the triangles beside it in two: two more
 * at the end, or one for an edge of the boundary. */
void iccp_cut_edge(iccp_corners *corners, uint32_t corner, uint32_t m);

/* Replaces the edge, which is not on the boundary, by the other diagonal of its two triangles. */
void iccp_flip_edge(iccp_corners *corners, uint32_t corner);

/* Merges the vertex of a corner, no edge at which is on the boundary, into the vertex after it: the
 * triangle of the corner and the one beside that edge are of no use any more, and nothing names
 * them. The caller sees to it that no edge comes twice. */
void iccp_collapse_edge(iccp_corners *corners, uint32_t corner);

/* Finds the twins of the corners of triangles that are all counter-clockwise, from their vertices
 * alone, which are smaller than n_vertices. False when an edge belongs to two triangles on the same
 * side, or a corner's three vertices are not different: `corners->twin` is then of no use. O(n). */
icc_status iccp_find_twins(iccp_corners *corners, size_t n_vertices, bool *is_manifold,
                           const iccp_env *env);

#endif
