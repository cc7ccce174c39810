/* Decides which rings of two layers become part of the coverage. */
#ifndef ICCP_LEAVE_OUT_H
#define ICCP_LEAVE_OUT_H

#include "match/coverage/layer_pairing.h"
#include "match/coverage/layer_rings.h"

typedef struct iccp_kept {
    bool *ring;   /* of each ring of the source: it is part of the coverage */
    bool *border; /* of each border of the source: a ring of the coverage has it */
    size_t n_rings;
} iccp_kept;

/* Lists the borders of layer e (0 or 1) without a partner. Writes the first `capacity` differences
 * to `out`, which may be NULL. Returns their number. */
size_t iccp_borders_alone(icc_coverage_difference *out, size_t capacity,
                          const iccp_layer_pairing *pairing, int e);

/* Decides. The caller frees the result even after an error. */
icc_status iccp_kept_find(iccp_kept *kept, const iccp_layer_pairing *pairing,
                          const iccp_layer_rings *rings, const iccp_env *env);
/* Accepts a struct of zeros. */
void iccp_kept_free(iccp_kept *kept, const iccp_memory *memory);

#endif
