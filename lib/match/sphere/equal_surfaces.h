/* Tells if two surfaces are the same except for motion, size and numbering. */
#ifndef ICCP_EQUAL_SURFACES_H
#define ICCP_EQUAL_SURFACES_H

#include "match/surface/half_edges.h"

/* *found becomes true if the triangles of both surfaces are joined in the same way. Edges must have
 * equal lengths to within 0.001 after scaling, and all vertices must be present. vertices[0][k]
 * must then correspond to vertices[1][k], k < n. partner[v] of the second surface becomes the
 * vertex that corresponds to v. Surfaces that are too regular to be compared in O(n) are not found.
 * x has the coordinates by vertex. ICC_ERR_MEMORY without a text. */
icc_status iccp_equal_surfaces_find(uint32_t *partner, bool *found,
                                    const iccp_half_edges *const m[2], const double *const x[2],
                                    size_t n, const uint32_t *const vertices[2],
                                    const iccp_memory *memory);

#endif
