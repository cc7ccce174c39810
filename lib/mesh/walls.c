/* Segments that a triangulation of points must contain. */
#include "mesh/walls.h"

#include "base/sort.h"

icc_status iccp_walls_create(iccp_walls *walls, size_t n_points, size_t n_walls,
                             const uint32_t *pairs, const iccp_memory *memory)
{
    walls->first = iccp_alloc_zero(memory, n_points + 1, sizeof *walls->first);
    walls->other = iccp_alloc(memory, 2 * n_walls, sizeof *walls->other);
    walls->half = iccp_alloc(memory, 2 * n_walls, sizeof *walls->half);
    if (walls->first == NULL || walls->other == NULL || walls->half == NULL) {
        iccp_walls_free(walls, memory);
        return ICC_ERR_MEMORY;
    }
    iccp_list_groups(walls->half, walls->first, n_points, pairs, 2 * n_walls, 1);
    for (size_t k = 0; k < 2 * n_walls; ++k)
        walls->other[k] = pairs[walls->half[k] ^ 1];
    return ICC_OK;
}

void iccp_walls_free(iccp_walls *walls, const iccp_memory *memory)
{
    iccp_free(memory, walls->first);
    iccp_free(memory, walls->other);
    iccp_free(memory, walls->half);
    *walls = (iccp_walls){0};
}
