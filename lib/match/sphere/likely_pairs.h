/* Pairs of vertices of two surfaces that belong together as far as distances tell. */
#ifndef ICCP_LIKELY_PAIRS_H
#define ICCP_LIKELY_PAIRS_H

#include "match/surface/half_edges.h"

/* vertices[side][k]: of pair k < *n, 4 of them at least; there is room for `most`. Finds others,
 * and *n becomes so many more: vertices of the first surface that are far from all pairs so far,
 * and of the second the one whose distances from these, along edges, are most nearly the same, if
 * they are nearly so, and if the first is what is found from there. Where surfaces are stretched
 * much, or all pairs lie in a plane of symmetry, there may be none. x: coordinates by vertex,
 * scale: makes areas equal. ICC_ERR_MEMORY, ICC_ERR_CANCELLED without a text. O(most m log m) for
 * m vertices. */
icc_status iccp_likely_pairs_find(uint32_t *const vertices[2], size_t *n, size_t most,
                                  const iccp_half_edges *const m[2], const double *const x[2],
                                  const double scale[2], const iccp_env *env);

#endif
