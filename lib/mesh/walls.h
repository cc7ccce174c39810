/* Segments between points that a triangulation of the points must contain. */
#ifndef ICCP_WALLS_H
#define ICCP_WALLS_H

#include "base/memory.h"
#include "icc/base.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Stores the other ends of each point's walls. Wall k of the list is the half-wall 2 k when it is
 * followed from its first point, and 2 k + 1 when it is followed from its second one. */
typedef struct iccp_walls {
    uint32_t *first; /* n_points + 1 */
    uint32_t *other; /* the walls of point v: from first[v] to first[v + 1], in the order given */
    uint32_t *half;  /* the half-walls that lead there */
} iccp_walls;

/* Makes walls from n_walls pairs of points, which are smaller than n_points. */
icc_status iccp_walls_create(iccp_walls *walls, size_t n_points, size_t n_walls,
                             const uint32_t *pairs, const iccp_memory *memory);
void iccp_walls_free(iccp_walls *walls, const iccp_memory *memory);

/* Returns the half-wall from a to b, or UINT32_MAX. O(walls at the point that has fewer). */
static inline uint32_t iccp_walls_find(const iccp_walls *walls, uint32_t a, uint32_t b)
{
    const uint32_t *const first = walls->first;
    const uint32_t is_back = first[b + 1] - first[b] < first[a + 1] - first[a];
    const uint32_t from = is_back ? b : a, to = is_back ? a : b;
    for (uint32_t k = first[from]; k < first[from + 1]; ++k)
        if (walls->other[k] == to)
            return walls->half[k] ^ is_back;
    return UINT32_MAX;
}

/* Returns true if there is a wall between a and b. */
static inline bool iccp_walls_have(const iccp_walls *walls, uint32_t a, uint32_t b)
{
    return iccp_walls_find(walls, a, b) != UINT32_MAX;
}

#endif
