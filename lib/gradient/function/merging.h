/* Compression and expansion facets of a function on a grid; in 2-D they are edges. */
#ifndef ICCP_MERGING_H
#define ICCP_MERGING_H

#include "gradient/function/function.h"

/* Counts facets between two simplices that have values at every corner and at least one inside
 * corner. */
typedef struct iccp_facet_count {
    size_t n_tested;
    size_t n_compression;
    size_t n_expansion;
} iccp_facet_count;

/* See icc_function_get_facets(). Writes the first `capacity` compression and expansion facets, and
 * counts all. */
icc_status iccp_function_facets(const icc_function *function, size_t capacity, uint32_t *facets,
                                int32_t *kinds, iccp_facet_count *count, const iccp_env *env);

#endif
