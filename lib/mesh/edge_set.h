/* Some edges of a mesh, told by their ends. */
#ifndef ICCP_EDGE_SET_H
#define ICCP_EDGE_SET_H

#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct iccp_edge_set {
    iccp_memory memory;
    size_t n;
    uint32_t *ends; /* 2 n: each edge once, the smaller end first, in rising order */
} iccp_edge_set;

/* Adds n edges. Some may be there already. O(m log m) for m edges in the end. */
icc_status iccp_edge_set_add(iccp_edge_set *set, size_t n, const uint32_t *ends);
void iccp_edge_set_free(iccp_edge_set *set);

/* Whether two vertices are the ends of such an edge. A set that is NULL is empty. O(log n). */
bool iccp_edge_set_has(const iccp_edge_set *set, uint32_t a, uint32_t b);

#endif
