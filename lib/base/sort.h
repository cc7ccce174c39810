/* Sorting without memory of its own, which qsort() may take. */
#ifndef ICCP_SORT_H
#define ICCP_SORT_H

#include "base/compiler.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* As qsort(), NULL being fine for no items. Of equal items any may come first. O(n log n). */
void iccp_sort(void *items, size_t n, size_t size, int (*compare)(const void *, const void *));

/* Sorts keys by their bits from `shift`, 28 to 36, on; equal ones stay in their order. `work` has
 * room for n. O(n). */
void iccp_sort_keys(uint64_t *keys, uint64_t *work, size_t n, int shift);

/* The counting sort: items by their keys below n_keys, which are their first members, uint32_t.
 * Those with key k become sorted[first[k]] up to first[k + 1], in the order they had; `first` is
 * n_keys + 1 zeros before. Inlined: items of a known size are copied fast. O(n + n_keys). */
static ICCP_INLINE void iccp_sort_by_count(void *sorted, uint32_t *first, size_t n_keys,
                                           const void *items, size_t n, size_t size)
{
    const unsigned char *const from = items;
    unsigned char *const to = sorted;
    uint32_t key;
    for (size_t i = 0; i < n; ++i) {
        memcpy(&key, from + size * i, sizeof key);
        ++first[key];
    }
    for (size_t k = 0; k < n_keys; ++k)
        first[k + 1] += first[k];
    /* From the ends, which leaves `first` at the beginnings. */
    for (size_t i = n; i-- > 0;) {
        memcpy(&key, from + size * i, sizeof key);
        memcpy(to + size * --first[key], from + size * i, size);
    }
}

/* By the same sort, which of n groups of `size` keys below n_keys have each: for key k, once for
 * each time that they do, groups[first[k]] up to first[k + 1], rising. `first` is zeros before. */
void iccp_list_groups(uint32_t *groups, uint32_t *first, size_t n_keys, const uint32_t *keys,
                      size_t n, size_t size);

/* Of n items, one that none is greater than comes first; and the first of them becomes the last,
 * one of the greatest among the others the first. O(n) and O(log n): where a few are enough. */
void iccp_sort_begin(void *items, size_t n, size_t size,
                     int (*compare)(const void *, const void *));
void iccp_sort_next(void *items, size_t n, size_t size, int (*compare)(const void *, const void *));

/* Whether index a belongs before index b. */
typedef bool (*iccp_is_less)(const void *context, uint32_t a, uint32_t b);

/* Merges in[0..n_left) and in[n_left..n) into out. Outlines come in long monotone runs, so two
 * halves are often in order already. */
static ICCP_INLINE void iccp_merge_indices(uint32_t *out, const uint32_t *in, size_t n_left,
                                           size_t n, const void *context, iccp_is_less is_less)
{
    size_t left = 0, right = n_left;
    if (right == n || !is_less(context, in[right], in[right - 1])) {
        memcpy(out, in, n * sizeof *out);
        return;
    }
    for (size_t k = 0; k < n; ++k)
        if (right == n || (left < n_left && !is_less(context, in[right], in[left])))
            out[k] = in[left++];
        else
            out[k] = in[right++];
}

/* Sorts n indices; equal ones stay in their order. `work` has room for n. Merge sort from the
 * bottom up (D. E. Knuth, The Art of Computer Programming 3, section 5.2.4), inlined so that
 * comparisons cost no calls. */
static ICCP_INLINE void iccp_sort_indices(uint32_t *indices, uint32_t *work, size_t n,
                                          const void *context, iccp_is_less is_less)
{
    uint32_t *from = indices, *to = work;
    for (size_t width = 1; width < n; width *= 2) {
        for (size_t i = 0; i < n; i += 2 * width) {
            const size_t left = n - i < width ? n - i : width;
            const size_t both = n - i < 2 * width ? n - i : 2 * width;
            iccp_merge_indices(to + i, from + i, left, both, context, is_less);
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != indices)
        memcpy(indices, from, n * sizeof *indices);
}

#endif
