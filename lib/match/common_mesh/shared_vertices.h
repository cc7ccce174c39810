/* Which vertices two drawings on the sphere have in common. */
#ifndef ICCP_SHARED_VERTICES_H
#define ICCP_SHARED_VERTICES_H

#include "match/common_mesh/arc_walk.h"

/* Makes and fills in `number` and `partner` of two drawings: vertices with the same direction are
 * one and have the number of the first drawing's; numbers of the others follow the first drawing's
 * vertices. *n_different: vertices that are there, each once. To be freed in any case.
 * ICC_ERR_MEMORY without a text. O(n log n). */
icc_status iccp_shared_vertices_find(iccp_drawing drawing[2], size_t *n_different,
                                     const iccp_memory *memory);

#endif
