/* Tests whether triangles meet when most of their boxes overlap, because many triangles are long
 * and thin or share a corner. */
#ifndef ICCP_NEEDLES_H
#define ICCP_NEEDLES_H

#include "base/env.h"
#include "geometry/facet_tree.h"

/* Passes all pairs of places in the tree that may meet to `meet`, until it returns true. Returns
 * ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. Visits O(n log n) pairs unless very many triangles
 * nearly touch. */
icc_status iccp_needles_compare(const iccp_facet_tree *tree, size_t n_vertices,
                                bool (*meet)(void *context, uint32_t p, uint32_t q), void *context,
                                const iccp_env *env);

#endif
