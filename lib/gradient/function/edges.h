/* Compression and expansion edges of a function on a 2-D grid. */
#ifndef ICCP_EDGES_H
#define ICCP_EDGES_H

#include "gradient/function/function.h"

/* Counts edges between two triangles that have values at every corner and at least one inside
 * corner. */
typedef struct iccp_edge_count {
    size_t n_tested;
    size_t n_compression;
    size_t n_expansion;
} iccp_edge_count;

/* See icc_function_get_edges(). Writes the first `capacity` compression and expansion edges, and
 * counts all. The grid is 2-D. */
iccp_edge_count iccp_function_edges(const icc_function *function, size_t capacity, uint32_t *edges,
                                    int32_t *kinds);

/* Counts the edges. The grid is 2-D. */
void iccp_function_count_edges(const icc_function *function, size_t *n_tested,
                               size_t *n_compression, size_t *n_expansion);

#endif
