/* The crossings that two drawings, each walked through the other, have found: the same. */
#ifndef ICCP_PAIRED_CROSSINGS_H
#define ICCP_PAIRED_CROSSINGS_H

#include "match/common_mesh/arc_walk.h"

typedef struct iccp_paired_crossings {
    uint32_t *place;      /* of each crossing of the first walk, its place in the second one */
    uint32_t *edge_of[2]; /* of each crossing of a walk, the half-edge that was walked */
} iccp_paired_crossings;

/* ICC_ERR_CERTIFICATE unless both walks have crossed the same pairs of edges, each once, and the
 * same way; ICC_ERR_MEMORY. All zeros before; to be freed in any case. O(n log n). */
icc_status iccp_paired_crossings_create(iccp_paired_crossings *paired,
                                        const iccp_drawing drawing[2], const iccp_arc_walk walk[2],
                                        const iccp_env *env, icc_error *err);
void iccp_paired_crossings_free(iccp_paired_crossings *paired, const iccp_memory *memory);

#endif
