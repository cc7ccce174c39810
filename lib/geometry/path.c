/* A polyline with its arc length. */
#include "geometry/path.h"

#include <assert.h>
#include <string.h>

/* Doubles: enough for a few hundred points in the plane or in space. */
enum { FIRST_CAPACITY = 1024 };

void iccp_path_init(iccp_path *path, const iccp_memory *memory)
{
    *path = (iccp_path){.memory = memory};
}

void iccp_path_clear(iccp_path *path)
{
    iccp_free(path->memory, path->points);
    iccp_free(path->memory, path->marks);
    iccp_path_init(path, path->memory);
}

bool iccp_path_grow(iccp_path *path)
{
    const size_t capacity = path->capacity > 0 ? 2 * path->capacity : FIRST_CAPACITY;
    double *points =
        iccp_grow(path->memory, path->points, (path->dim + 1) * path->n, capacity, sizeof *points);
    if (points == NULL)
        return false;
    path->points = points;
    path->capacity = capacity;
    return true;
}

icc_status iccp_path_append(iccp_path *path, const double *point, double s)
{
    double *row = iccp_path_extend(path);
    if (row == NULL)
        return ICC_ERR_MEMORY;
    memcpy(row, point, path->dim * sizeof *point);
    row[path->dim] = s;
    return ICC_OK;
}

size_t iccp_path_find(const iccp_path *path, double s, double *share)
{
    assert(path->n >= 2);
    size_t low = 0, high = path->n - 1;
    while (high - low > 1) {
        const size_t middle = low + (high - low) / 2;
        if (iccp_path_length_at(path, middle) <= s)
            low = middle;
        else
            high = middle;
    }
    const double from = iccp_path_length_at(path, low), to = iccp_path_length_at(path, low + 1);
    *share = to > from ? (s - from) / (to - from) : 0;
    return low;
}

void iccp_path_point(const iccp_path *path, size_t piece, double share, double *point)
{
    const double *a = iccp_path_at(path, piece), *b = iccp_path_at(path, piece + 1);
    for (size_t k = 0; k < path->dim; ++k)
        point[k] = a[k] + share * (b[k] - a[k]);
}
