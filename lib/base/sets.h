/* Disjoint sets of numbers (union-find), each with a leader. Source: R. E. Tarjan, J. van Leeuwen,
 * Worst-case analysis of set union algorithms, 1984, with path halving. The smallest number of a
 * set is its leader. */
#ifndef ICCP_SETS_H
#define ICCP_SETS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Puts each of n numbers into a set of its own. */
static inline void iccp_sets_begin(uint32_t *leader, size_t n)
{
    for (size_t i = 0; i < n; ++i)
        leader[i] = (uint32_t)i;
}

static inline uint32_t iccp_sets_leader(uint32_t *leader, uint32_t i)
{
    while (leader[i] != i)
        i = leader[i] = leader[leader[i]];
    return i;
}

/* Unites the sets of i and j. Returns true if they were different. */
static inline bool iccp_sets_join(uint32_t *leader, uint32_t i, uint32_t j)
{
    const uint32_t a = iccp_sets_leader(leader, i), b = iccp_sets_leader(leader, j);
    leader[a < b ? b : a] = a < b ? a : b;
    return a != b;
}

#endif
