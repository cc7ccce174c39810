/* Pairs the crossings of two walks, one through each drawing, which must be the same. */
#ifndef ICCP_PAIRED_CROSSINGS_H
#define ICCP_PAIRED_CROSSINGS_H

#include "match/common_mesh/arc_walk.h"

typedef struct iccp_paired_crossings {
    uint32_t *place;      /* of each crossing of the first walk: its place in the second one */
    uint32_t *edge_of[2]; /* of each crossing of a walk: the half-edge that was walked */
} iccp_paired_crossings;

/* ICC_ERR_CERTIFICATE unless both walks crossed the same pairs of edges, each once and in the same
 * direction. ICC_ERR_MEMORY. `paired` must be zeros before. Free it in any case. O(n log n). */
icc_status iccp_paired_crossings_create(iccp_paired_crossings *paired,
                                        const iccp_drawing drawing[2], const iccp_arc_walk walk[2],
                                        const iccp_env *env, icc_error *err);
void iccp_paired_crossings_free(iccp_paired_crossings *paired, const iccp_memory *memory);

#endif
