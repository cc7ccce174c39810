/* Merge sort from the bottom up (D. E. Knuth, The Art of Computer Programming 3, section 5.2.4). */
#include "tree/sort.h"

#include <string.h>

/* Merges in[0..n_remaining) and in[n_left..n) into out. */
static void merge(uint32_t *out, const uint32_t *in, size_t n_left, size_t n, const double *values)
{
    size_t left = 0, right = n_left;
    for (size_t k = 0; k < n; ++k)
        if (right == n || (left < n_left && values[in[left]] >= values[in[right]]))
            out[k] = in[left++];
        else
            out[k] = in[right++];
}

void iccp_sort_falling(uint32_t *vertices, uint32_t *work, size_t n, const double *values)
{
    uint32_t *from = vertices, *to = work;
    for (size_t width = 1; width < n; width *= 2) {
        for (size_t i = 0; i < n; i += 2 * width) {
            const size_t left = n - i < width ? n - i : width;
            const size_t both = n - i < 2 * width ? n - i : 2 * width;
            merge(to + i, from + i, left, both, values);
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != vertices)
        memcpy(vertices, from, n * sizeof *vertices);
}
