/* Finds pairs of vertices of two surfaces that correspond, judged by distances. */
#ifndef ICCP_LIKELY_PAIRS_H
#define ICCP_LIKELY_PAIRS_H

#include "match/surface/half_edges.h"

/* vertices[side][k], k < *n, are at least 4 given pairs. There is room for `most`. Finds more pairs
 * and adds their number to *n. On the first surface it takes vertices far from all pairs. The
 * partner is the vertex of the second surface with the most similar distances to the pairs, along
 * edges. A pair is accepted if the distances are nearly the same and the search back from the
 * partner finds the first vertex. There may be none if surfaces are stretched much or all pairs lie
 * in a plane of symmetry. x has coordinates by vertex; `scale` makes areas equal. ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED without a text. O(most m log m) for m vertices. */
icc_status iccp_likely_pairs_find(uint32_t *const vertices[2], size_t *n, size_t most,
                                  const iccp_half_edges *const m[2], const double *const x[2],
                                  const double scale[2], const iccp_env *env);

#endif
