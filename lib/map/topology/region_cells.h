/* The edges and faces of one region of a mesh of tetrahedra, and what meets what.
 *
 * Words of this folder, which finds out that two bodies have no map. Begin with this file, end with
 * no_map.h.
 * - region: tetrahedra with the same region number, or a whole mesh. The surface of a region is the
 *   boundary of the mesh and the inner surfaces around it. It has components.
 * - class: an element of the first cohomology, modulo a prime (math/residue.h). It is a number for
 *   each edge, read from the smaller vertex to the larger one. The numbers around a triangle have
 *   sum 0, so a class has the same sum along any two loops that bound a surface together.
 * - bound: a loop bounds in a region if it is the boundary of a surface there. Then all classes
 *   have sum 0 along it. For a region in space, the opposite is true as well.
 * - handle: every component that is not a sphere has some. Half of the loops around handles and
 *   through them bound on one side of the component.
 * - witness: a loop that bounds in one of two regions only. It proves that there is no map.
 *
 * Ways: region_surface.h lists the surface and its loops. region_classes.h finds all classes.
 * witness.h compares the two regions by linear algebra and says which components differ.
 * witness_loop.h draws the loop on the surface. no_map.h writes the message. */
#ifndef ICCP_REGION_CELLS_H
#define ICCP_REGION_CELLS_H

#include "geometry/simplices.h"

/* A mesh and one of its regions. */
typedef struct iccp_region {
    const iccp_simplices *mesh; /* in space; without region numbers, it is the only region */
    uint32_t number;
} iccp_region;

static inline bool iccp_region_has(const iccp_region *region, size_t simplex)
{
    return region->mesh->region == NULL || region->mesh->region[simplex] == region->number;
}

/* Returns true if the surface of the region contains this side of one of its tetrahedra. */
static inline bool iccp_region_ends(const iccp_region *region, size_t side)
{
    const uint32_t across = region->mesh->across[side];
    return (across & ICCP_ON_BOUNDARY) != 0 || !iccp_region_has(region, across / 4);
}

#define ICCP_OUTSIDE UINT32_MAX

typedef struct iccp_region_cells {
    iccp_memory memory;
    size_t n_simplices, n_vertices; /* of the mesh */
    size_t n_edges, n_faces;        /* of the region */
    uint32_t *ends;                 /* 2 per edge, ascending; edges are sorted by them */
    uint32_t *face_edges;           /* 3 per face with vertices a < b < c: ab, bc, ac */
    uint32_t
        *face_sides; /* 2 per face: its tetrahedra, the second one ICCP_OUTSIDE on the surface */
    uint32_t *face_first; /* of each edge: its first face in `at_edge`, and the end */
    uint32_t *at_edge;
    uint32_t *edge_first; /* of each vertex: its first edge in `at_vertex`, and the end */
    uint32_t *at_vertex;
} iccp_region_cells;

/* Returns ICC_OK or ICC_ERR_MEMORY. Time is linear. */
icc_status iccp_region_cells_create(iccp_region_cells *cells, const iccp_region *region,
                                    const iccp_memory *memory);
void iccp_region_cells_free(iccp_region_cells *cells);

/* Returns the edge between vertices a < b, or n_edges if there is none. */
size_t iccp_region_edge(const iccp_region_cells *cells, uint32_t a, uint32_t b);

#endif
