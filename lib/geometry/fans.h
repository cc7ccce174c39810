/* Finds vertices of a closed surface at which adjacent triangles cannot intersect. */
#ifndef ICCP_FANS_H
#define ICCP_FANS_H

#include "base/memory.h"
#include "geometry/facet_tree.h"

#include <stdint.h>

/* Returns an array by vertex, or NULL if there is no memory. 1 means that any two triangles at the
 * vertex certainly share only their common corners or side. 0 means unknown. The triangles at each
 * vertex must form one ring. Exact. O(n). */
uint8_t *iccp_fans_find(const iccp_facet_tree *tree, size_t n_vertices, const iccp_memory *memory);

#endif
