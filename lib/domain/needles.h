/* Whether triangles meet of which so many are long and thin, or have a corner in common, that most
 * of their boxes overlap. */
#ifndef ICCP_NEEDLES_H
#define ICCP_NEEDLES_H

#include "base/env.h"
#include "domain/facet_tree.h"

/* Passes pairs of places in the tree to `meet`, until it finds that one meets: all pairs but those
 * that cannot meet. ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. O(n log n) pairs unless very many
 * triangles nearly touch. */
icc_status iccp_needles_compare(const iccp_facet_tree *tree, size_t n_vertices,
                                bool (*meet)(void *context, uint32_t p, uint32_t q), void *context,
                                const iccp_env *env);

#endif
