/* The ways round the faces of dimension dim - 2 of a mesh: vertices of triangles, edges of
 * tetrahedra. */
#ifndef ICCP_RINGS_H
#define ICCP_RINGS_H

#include "domain/simplices.h"

/* Facets are numbered here, those of the domain and those within the star of the centre left out.
 * Ring r consists of the steps first[r] to first[r + 1]: 2 * facet, + 1 where the way crosses the
 * facet from the greater of its two sides. */
typedef struct iccp_rings {
    iccp_memory memory;
    size_t n_facets;
    uint32_t *side; /* the smaller of a facet's two sides */
    size_t n;
    size_t *first; /* n + 1 */
    uint32_t *step;
} iccp_rings;

/* For all faces within the domain that do not have the centre for a corner. The star of the centre
 * is crossed without a step. O(n). */
icc_status iccp_rings_create(iccp_rings *rings, const iccp_simplices *mesh, uint32_t centre,
                             const iccp_env *env);
void iccp_rings_free(iccp_rings *rings);

#endif
