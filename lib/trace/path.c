#include "trace/path.h"

#include <assert.h>

void iccp_path_init(iccp_path *path, const iccp_memory *memory)
{
    *path = (iccp_path){.memory = memory};
}

void iccp_path_clear(iccp_path *path)
{
    iccp_free(path->memory, path->points);
    iccp_path_init(path, path->memory);
}

icc_status iccp_path_append(iccp_path *path, double x, double y, double s)
{
    if (path->n == path->capacity) {
        const size_t capacity = path->capacity > 0 ? 2 * path->capacity : 256;
        iccp_path_point *points =
            iccp_grow(path->memory, path->points, path->n, capacity, sizeof *points);
        if (points == NULL)
            return ICC_ERR_MEMORY;
        path->points = points;
        path->capacity = capacity;
    }
    path->points[path->n++] = (iccp_path_point){x, y, s};
    return ICC_OK;
}

size_t iccp_path_find(const iccp_path *path, double s)
{
    assert(path->n >= 2);
    size_t low = 0, high = path->n - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (path->points[middle].s <= s)
            low = middle;
        else
            high = middle;
    }
    return low;
}
