/* The order in which to insert points into a triangulation. */
#ifndef ICCP_INSERTION_ORDER_H
#define ICCP_INSERTION_ORDER_H

#include "base/env.h"

#include <stddef.h>

/* Writes a permutation of 0..n-1, n <= 2^28. It consists of rounds of randomly picked points. Each
 * round is a few times as large as all earlier rounds together, and follows a space-filling curve.
 * Points have dim coordinates, 2 or 3. The result is the same on every machine. Returns ICC_OK or
 * ICC_ERR_MEMORY. */
icc_status iccp_insertion_order(uint32_t *order, size_t n, size_t dim, const double *points,
                                const iccp_memory *memory);

#endif
