/* The vertices of the meshes on which biharmonic weights are found: the nodes, and points on walls.
 *
 * Words of this folder. Begin with biharmonic.h.
 * - node: a point at which weights are stored (kernel/weights/weights.h).
 * - wall: a side of a region's boundary. A point on a wall belongs to the region that the boundary
 *   encloses (kernel/sampling/shape.h).
 * - piece: a part of a wall between two vertices.
 * - parent: the region directly around another region.
 * - held: a vertex whose weights are given.
 *
 * Ways: region_vertices.h cuts the walls into pieces, region_mesh.h makes triangles between them,
 * biharmonic_energy.h has the energy of a mesh, bounded_program.h minimises it between 0 and 1.
 * biharmonic.h puts these together.
 *
 * Invariant: meshes of two regions share exactly the vertices on the walls between them. */
#ifndef ICCP_REGION_VERTICES_H
#define ICCP_REGION_VERTICES_H

#include "kernel/sampling/shape.h"

typedef struct iccp_region_vertices {
    iccp_memory memory;
    size_t n, n_pieces;
    double *points;   /* 2 n, local: the nodes, then points on walls that are no nodes */
    uint32_t *region; /* n: the region that each belongs to, by the rule for walls */
    uint32_t *pieces; /* 2 n_pieces: ends, in the direction of the wall */
    uint32_t *owner;  /* n_pieces: the region that the wall encloses, in rising order */
} iccp_region_vertices;

/* Makes the vertices for n nodes in the caller's coordinates. Pieces of walls are about as
 * long as `spacing`, in the caller's units, or shorter. Returns ICC_ERR_UNSUPPORTED if a node is in
 * no region, and ICC_ERR_RESOLUTION if there would be more than 2^24 vertices. */
icc_status iccp_region_vertices_create(iccp_region_vertices *vertices, const icc_shape *shape,
                                       size_t n, const double *nodes, double spacing,
                                       const iccp_env *env, icc_error *err);
void iccp_region_vertices_free(iccp_region_vertices *vertices);

#endif
