/* Finds the vertices that two drawings on the sphere have in common. */
#ifndef ICCP_SHARED_VERTICES_H
#define ICCP_SHARED_VERTICES_H

#include "match/common_mesh/arc_walk.h"

/* Makes `number` and `partner` of two drawings. Vertices with the same direction are one and have
 * the number of the first drawing's vertex. The numbers of the others follow those of the first
 * drawing. *n_different counts the present vertices, each once. Free them in any case.
 * ICC_ERR_MEMORY without a text. O(n log n). */
icc_status iccp_shared_vertices_find(iccp_drawing drawing[2], size_t *n_different,
                                     const iccp_memory *memory);

#endif
