/* Sorting without allocation, which qsort() may need. */
#ifndef ICCP_SORT_H
#define ICCP_SORT_H

#include "base/compiler.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* Like qsort(), but `items` may be NULL if n is 0. The order of equal items is not specified. O(n
 * log n). */
void iccp_sort(void *items, size_t n, size_t size, int (*compare)(const void *, const void *));

/* Returns the value that belongs at place k of n numbers in rising order, and moves it there. C. A.
 * R. Hoare, Algorithm 65: Find, 1961. Expected time O(n). */
double iccp_select(double *x, size_t n, size_t k);

/* Sorts keys by their bits from `shift` (28 to 36) upwards. Equal keys keep their order. `work` has
 * room for n. O(n). */
void iccp_sort_keys(uint64_t *keys, uint64_t *work, size_t n, int shift);

/* Counting sort. The key of an item is its first member, a uint32_t below n_keys. Items with key k
 * become sorted[first[k]] up to first[k + 1] and keep their order. On entry `first` holds n_keys +
 * 1 zeros. The function is inlined so that items of a known size are copied fast. O(n + n_keys). */
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
    /* Backwards, so that `first` ends at the beginnings. */
    for (size_t i = n; i-- > 0;) {
        memcpy(&key, from + size * i, sizeof key);
        memcpy(to + size * --first[key], from + size * i, size);
    }
}

/* Lists, for each key below n_keys, the groups that contain it. There are n groups of `size` keys
 * each. The groups of key k are groups[first[k]] up to first[k + 1], in rising order, once for each
 * time that they contain k. On entry `first` is zeros. */
void iccp_list_groups(uint32_t *groups, uint32_t *first, size_t n_keys, const uint32_t *keys,
                      size_t n, size_t size);

/* Sorts only as many items as the caller needs, from the greatest on. begin() moves a greatest item
 * to the front, in O(n). next() moves the first item to the end of the n items, and a greatest of
 * the others to the front, in O(log n). */
void iccp_sort_begin(void *items, size_t n, size_t size,
                     int (*compare)(const void *, const void *));
void iccp_sort_next(void *items, size_t n, size_t size, int (*compare)(const void *, const void *));

/* Returns true if index a belongs before index b. */
typedef bool (*iccp_is_less)(const void *context, uint32_t a, uint32_t b);

/* Merges in[0..n_left) and in[n_left..n) into out. Outlines have long monotone runs, so the two
 * halves are often already in order. */
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

/* Sorts n indices; equal ones keep their order. `work` has room for n. Bottom-up merge sort (D. E.
 * Knuth, The Art of Computer Programming 3, section 5.2.4), inlined so that comparisons cost no
 * calls. */
static ICCP_INLINE void iccp_sort_indices(uint32_t *indices, uint32_t *work, size_t n,
                                          const void *context, iccp_is_less is_less)
{
    uint32_t *from = indices, *to = work;
    for (size_t width = 1; width < n; width *= 2) {
        for (size_t i = 0; i < n; i += 2 * width) {
            const size_t left = n - i < width ? n - i : width;
            const size_t merged = n - i < 2 * width ? n - i : 2 * width;
            iccp_merge_indices(to + i, from + i, left, merged, context, is_less);
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    if (from != indices)
        memcpy(indices, from, n * sizeof *indices);
}

#endif
