/* Whether two surfaces are one, moved, turned or made larger, its parts numbered in other ways. */
#ifndef ICCP_EQUAL_SURFACES_H
#define ICCP_EQUAL_SURFACES_H

#include "match/surface/half_edges.h"

/* *found: triangles of both, all of them there, are joined in the same ways, and when the surfaces
 * are equally large edges are as long to within 1/1000; vertices[0][k] then belongs to
 * vertices[1][k], k < n, and partner[v] of the second surface to vertex v. What is too regular to
 * be compared in O(n) is not found. x: coordinates by vertex. ICC_ERR_MEMORY without a text. */
icc_status iccp_equal_surfaces_find(uint32_t *partner, bool *found,
                                    const iccp_half_edges *const m[2], const double *const x[2],
                                    size_t n, const uint32_t *const vertices[2],
                                    const iccp_memory *memory);

#endif
