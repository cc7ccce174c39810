/* Orders of simplices made better facet by facet. */
#ifndef ICCP_REVERSE_H
#define ICCP_REVERSE_H

#include "shelling/shelling_order.h"

/* Reverses facets that the flux of `priority` crosses from smaller to greater rank, those with much
 * of it first, wherever the order stays one like those of shelling/shelling_order.h, and ranks the
 * simplices anew. `rank`, of each simplex, is complete. O(n log n) a pass, of which there are at
 * most 20. ICC_OK, ICC_ERR_MEMORY or ICC_ERR_CANCELLED. */
icc_status iccp_order_reverse(const iccp_order_priority *priority, uint32_t *rank,
                              size_t *n_reversed, const iccp_env *env);

#endif
