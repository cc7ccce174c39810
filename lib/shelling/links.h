/* The links of a mesh's faces of dimension dim - 2: the cycles of simplices round them. These
 * faces are the vertices of triangles or the edges of tetrahedra. circulation.h sends flux round
 * the links. */
#ifndef ICCP_LINKS_H
#define ICCP_LINKS_H

#include "geometry/simplices.h"

/* Only facets between simplices are numbered here, without those in the star of the centre. Link
 * r consists of the steps first[r] to first[r + 1]. A step is 2 * facet, or 2 * facet + 1 if it
 * crosses the facet from the greater of its two sides. */
typedef struct iccp_links {
    iccp_memory memory;
    size_t n_facets;
    uint32_t *side; /* the smaller of a facet's two sides */
    size_t n;
    size_t *first; /* n + 1 */
    uint32_t *step;
} iccp_links;

/* Finds the links of all faces inside the domain that do not have the centre as a corner. A walk
 * crosses the star of the centre without a step. O(n). */
icc_status iccp_links_create(iccp_links *links, const iccp_simplices *mesh, uint32_t centre,
                             const iccp_env *env);
void iccp_links_free(iccp_links *links);

#endif
