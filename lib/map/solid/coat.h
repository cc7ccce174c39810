/* The coat (a collar): the layer below the surface of a solid. Each vertex of the boundary gets a
 * point below it, if there is one that sees all faces at the vertex.
 *
 * The mesh inside these points is the core. It is the mesh as it was, and its boundary has the same
 * triangles. The coat has three tetrahedra below each face. */
#ifndef ICCP_COAT_H
#define ICCP_COAT_H

#include "geometry/simplices.h"

#define ICCP_NOTHING_BELOW UINT32_MAX

typedef struct iccp_coat {
    iccp_memory memory;
    iccp_simplices *core; /* its point v < n_boundary is the point below vertex v, or the vertex
                             itself */
    uint32_t *below;      /* of each vertex: the number of the point below it, 0, 1, ..., or
                        NOTHING_BELOW */
    size_t n_below;
    size_t n_tets;
    uint32_t *corners; /* 4 of each tetrahedron: vertices, or n_boundary + below[] of one */
} iccp_coat;

/* Makes the coat of a mesh that knows its neighbours. The caller's numbers are lost.
 * ICC_ERR_MEMORY. Free it even then. */
icc_status iccp_coat_create(iccp_coat *coat, const iccp_simplices *mesh, const iccp_memory *memory);
void iccp_coat_free(iccp_coat *coat);

#endif
