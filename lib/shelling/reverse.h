/* Improves orders of simplices facet by facet. Source: see reverse.c. */
#ifndef ICCP_REVERSE_H
#define ICCP_REVERSE_H

#include "shelling/shelling_order.h"

/* Reverses facets that the flux of `priority` crosses from smaller to greater rank, those with
 * the most flux first, and ranks the simplices anew. The order stays one as in
 * shelling/shelling_order.h. `rank`, by simplex, must be complete. Each of at most 20 passes
 * takes O(n log n). Returns ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
icc_status iccp_order_reverse(const iccp_order_priority *priority, uint32_t *rank,
                              size_t *n_reversed, const iccp_env *env);

#endif
