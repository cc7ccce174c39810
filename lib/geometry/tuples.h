/* Lists of vertices, all of the same length, such as the facets of a mesh: which of them are the
 * same. */
#ifndef ICCP_TUPLES_H
#define ICCP_TUPLES_H

#include "base/env.h"

#include <stdbool.h>

typedef struct iccp_tuples {
    iccp_memory memory;
    size_t n, width;    /* how many, and vertices of each */
    size_t n_vertices;  /* all are smaller */
    uint32_t *vertices; /* n * width: filled in by the caller, ascending in each tuple */
    uint32_t *order;    /* n: the tuples in the order of their vertices, the same ones by number */
    uint32_t *work, *count; /* n and n_vertices + 1: for the sort */
} iccp_tuples;

/* Makes room. n must be less than 2^32. */
icc_status iccp_tuples_create(iccp_tuples *tuples, size_t n, size_t width, size_t n_vertices,
                              const iccp_memory *memory);
void iccp_tuples_free(iccp_tuples *tuples);

/* Fills in `order`. */
void iccp_tuples_sort(iccp_tuples *tuples);

/* The place in `order`, behind `begin`, where other vertices than those at `begin` come. */
size_t iccp_tuples_end(const iccp_tuples *tuples, size_t begin);

/* Sorts a few vertices; returns whether that permutation is odd. */
static inline bool iccp_sort_vertices(size_t n, uint32_t *vertices)
{
    bool odd = false;
    for (size_t i = 1; i < n; ++i) {
        const uint32_t v = vertices[i];
        size_t k = i;
        for (; k > 0 && vertices[k - 1] > v; --k) {
            vertices[k] = vertices[k - 1];
            odd = !odd;
        }
        vertices[k] = v;
    }
    return odd;
}

#endif
