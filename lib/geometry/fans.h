/* Vertices of a closed surface round which its triangles cannot meet. */
#ifndef ICCP_FANS_H
#define ICCP_FANS_H

#include "base/memory.h"
#include "geometry/facet_tree.h"

#include <stdint.h>

/* For triangles of which those at each vertex form one ring: 1 by vertex where two triangles of the
 * ring certainly have no more in common than the corners or the side that they share, 0 elsewhere;
 * or NULL if there is no memory. Exact. O(n). */
uint8_t *iccp_fans_find(const iccp_facet_tree *tree, size_t n_vertices, const iccp_memory *memory);

#endif
