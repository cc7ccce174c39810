/* The surface of a region as a graph, and loops that generate its first homology. */
#ifndef ICCP_REGION_SURFACE_H
#define ICCP_REGION_SURFACE_H

#include "map/topology/region_cells.h"

typedef struct iccp_region_surface {
    iccp_memory memory;
    size_t n_vertices; /* of the mesh */
    size_t n_faces, n_edges, n_components;
    uint32_t *ends;       /* 2 per edge, ascending */
    uint32_t *edge_first; /* of each vertex: its first edge in `at_vertex`, and the end */
    uint32_t *at_vertex;
    size_t n_tree;       /* vertices of the surface */
    uint32_t *tree;      /* these, each after its parent; components one after the other */
    uint32_t *parent;    /* of each vertex: the edge to its parent, or ICCP_OUTSIDE */
    uint32_t *component; /* of each vertex of the surface; ICCP_OUTSIDE for others */
    /* An edge of each loop: the tree joins its ends. The loops of component c, two for each of its
     * handles, are loops[loop_first[c]] up to loops[loop_first[c + 1]]. */
    uint32_t *loops, *loop_first;
    uint32_t *root; /* the smallest vertex of each component */
} iccp_region_surface;

/* Returns ICC_OK or ICC_ERR_MEMORY. Time is linear but for inverse Ackermann. */
icc_status iccp_region_surface_create(iccp_region_surface *surface, const iccp_region *region,
                                      const iccp_memory *memory);
void iccp_region_surface_free(iccp_region_surface *surface);

static inline size_t iccp_surface_n_loops(const iccp_region_surface *surface)
{
    return surface->loop_first[surface->n_components];
}

#endif
