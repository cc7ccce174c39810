/* Finds equal tuples among lists of vertices that all have the same length, such as the facets of a
 * mesh. */
#ifndef ICCP_TUPLES_H
#define ICCP_TUPLES_H

#include "base/env.h"

#include <stdbool.h>

typedef struct iccp_tuples {
    iccp_memory memory;
    size_t n, width;        /* number of tuples, and vertices of each */
    size_t n_vertices;      /* all vertices are smaller */
    uint32_t *vertices;     /* n * width: the caller fills it in, ascending in each tuple */
    uint32_t *order;        /* n: tuples sorted by their vertices, equal ones by number */
    uint32_t *work, *count; /* n and n_vertices + 1: workspace of the sort */
} iccp_tuples;

/* Allocates the arrays. n must be less than 2^32. */
icc_status iccp_tuples_create(iccp_tuples *tuples, size_t n, size_t width, size_t n_vertices,
                              const iccp_memory *memory);
void iccp_tuples_free(iccp_tuples *tuples);

/* Fills in `order`. */
void iccp_tuples_sort(iccp_tuples *tuples);

/* Returns the place in `order` after `begin` where the next different tuple begins. */
size_t iccp_tuples_end(const iccp_tuples *tuples, size_t begin);

/* Sorts a few vertices. Returns true if the permutation is odd. */
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
