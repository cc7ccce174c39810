/* Merge sort from the bottom up (D. E. Knuth, The Art of Computer Programming 3, section 5.2.4).
 * Needs no memory of its own, which qsort() may. */
#include "domain/point_order.h"

#include "domain/segment.h"

#include <string.h>

/* Merges in[0..n_left) and in[n_left..n) into out. Outlines come in long monotone runs, so two
 * halves are often in order already. */
static void merge(uint32_t *out, const uint32_t *in, size_t n_left, size_t n, const double *points)
{
    size_t left = 0, right = n_left, k = 0;
    if (right == n || !iccp_point_less(points + 2 * in[right], points + 2 * in[right - 1])) {
        memcpy(out, in, n * sizeof *out);
        return;
    }
    while (left < n_left && right < n) {
        const uint32_t i = in[left], j = in[right];
        const bool take_right = iccp_point_less(points + 2 * (size_t)j, points + 2 * (size_t)i);
        out[k++] = take_right ? j : i;
        left += !take_right;
        right += take_right;
    }
    memcpy(out + k, in + left, (n_left - left) * sizeof *out);
    memcpy(out + k + (n_left - left), in + right, (n - right) * sizeof *out);
}

void iccp_order_points(uint32_t *order, uint32_t *work, size_t n, const double *points)
{
    uint32_t *from = order, *to = work;
    for (size_t width = 1; width < n; width *= 2) {
        for (size_t i = 0; i < n; i += 2 * width) {
            const size_t left = n - i < width ? n - i : width;
            const size_t both = n - i < 2 * width ? n - i : 2 * width;
            merge(to + i, from + i, left, both, points);
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != order)
        memcpy(order, from, n * sizeof *order);
}
