/* The order in which to insert points into a triangulation. */
#ifndef ICCP_INSERTION_ORDER_H
#define ICCP_INSERTION_ORDER_H

#include "base/env.h"

#include <stddef.h>

/* Fills in a permutation of 0..n-1, n <= 2^28: rounds of points picked at random, each some times
 * as large as those before it together, and along a space-filling curve within a round. Points are
 * of dim coordinates, 2 or 3. The same for the
 * same points on every machine. ICC_OK or ICC_ERR_MEMORY. */
icc_status iccp_insertion_order(uint32_t *order, size_t n, size_t dim, const double *points,
                                const iccp_memory *memory);

#endif
