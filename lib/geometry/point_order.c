/* Sorts points by x, then y. */
#include "geometry/point_order.h"

#include "base/sort.h"
#include "geometry/segment.h"

static bool is_less(const void *context, uint32_t a, uint32_t b)
{
    const double *points = context;
    return iccp_point_less(points + 2 * (size_t)a, points + 2 * (size_t)b);
}

void iccp_order_points(uint32_t *order, uint32_t *work, size_t n, const double *points)
{
    iccp_sort_indices(order, work, n, points, is_less);
}
