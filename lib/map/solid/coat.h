/* The layer below the surface of a body: a point under each vertex of the boundary, as far as there
 * is one that sees all faces at it. What is inside of these points, the core, is the mesh as it
 * was, with a boundary of the same triangles; the coat has three tetrahedra below each face. */
#ifndef ICCP_COAT_H
#define ICCP_COAT_H

#include "geometry/simplices.h"

#define ICCP_NOTHING_BELOW UINT32_MAX

typedef struct iccp_coat {
    iccp_memory memory;
    iccp_simplices *core; /* its point v < n_boundary is the one below vertex v, or that vertex */
    uint32_t *below; /* of each vertex: 0, 1, .. if there is a point below it, or NOTHING_BELOW */
    size_t n_below;
    size_t n_tets;
    uint32_t *corners; /* 4 of each tetrahedron: vertices, or n_boundary + below[] of one */
} iccp_coat;

/* Of a mesh that knows its neighbours; the caller's numbers are not kept. ICC_ERR_MEMORY; to be
 * freed all the same. */
icc_status iccp_coat_create(iccp_coat *coat, const iccp_simplices *mesh, const iccp_memory *memory);
void iccp_coat_free(iccp_coat *coat);

#endif
