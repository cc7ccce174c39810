/* Makes a map from a triangle mesh and the images of its vertices. */
#ifndef ICCP_GIVEN_MESH_H
#define ICCP_GIVEN_MESH_H

#include "map/map.h"

/* All arrays are borrowed. */
typedef struct iccp_given_mesh {
    size_t n_vertices;
    const double *points, *images; /* 2 n_vertices each, in the caller's coordinates */
    size_t n_triangles;
    const uint32_t *triangles; /* 3 n_triangles, counter-clockwise before the map */
    size_t n_held;
    const uint32_t *held; /* n_held vertices inside that become point features */
} iccp_given_mesh;

/* Makes and certifies the map. Its domains are the outline of the mesh and of its image, whose
 * holes and held vertices become features. Vertices and triangles keep their numbers and their
 * bits.
 *
 * Returns
 * - ICC_ERR_BOUNDARY if the mesh is not a manifold or has a vertex without triangles, or if the
 *   boundary meets itself or a held vertex, before or after the map
 * - ICC_ERR_RESOLUTION if a coordinate is too small for exact signs
 * - ICC_ERR_TOPOLOGY if the mesh is not in one piece
 * - ICC_ERR_CERTIFICATE if a triangle is not positive on both sides. */
icc_status iccp_map_of_mesh(icc_map **out, const iccp_given_mesh *mesh, const iccp_env *env,
                            icc_error *err);

#endif
