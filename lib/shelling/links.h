/* The links of the faces of dimension dim - 2 of a mesh, vertices of triangles or edges of
 * tetrahedra: the cycles of simplices round them. */
#ifndef ICCP_LINKS_H
#define ICCP_LINKS_H

#include "geometry/simplices.h"

/* Facets are numbered here, those of the domain and those within the star of the centre left out.
 * Link r consists of the steps first[r] to first[r + 1]: 2 * facet, + 1 where the way crosses the
 * facet from the greater of its two sides. */
typedef struct iccp_links {
    iccp_memory memory;
    size_t n_facets;
    uint32_t *side; /* the smaller of a facet's two sides */
    size_t n;
    size_t *first; /* n + 1 */
    uint32_t *step;
} iccp_links;

/* For all faces within the domain that do not have the centre for a corner. The star of the centre
 * is crossed without a step. O(n). */
icc_status iccp_links_create(iccp_links *links, const iccp_simplices *mesh, uint32_t centre,
                             const iccp_env *env);
void iccp_links_free(iccp_links *links);

#endif
