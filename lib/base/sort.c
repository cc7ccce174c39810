/* Sorts arrays without allocation, by heapsort: J. W. J. Williams, Algorithm 232, 1964; R. W.
 * Floyd, Algorithm 245, 1964. */
#include "base/sort.h"

enum { DIGIT_BITS = 9 };

typedef struct heap {
    unsigned char *items;
    size_t size;
    int (*compare)(const void *, const void *);
} heap;

static void exchange(const heap *h, size_t i, size_t k)
{
    unsigned char *a = h->items + h->size * i, *b = h->items + h->size * k;
    size_t byte = 0;
    for (; byte + sizeof(uint64_t) <= h->size; byte += sizeof(uint64_t)) {
        uint64_t first, second;
        memcpy(&first, a + byte, sizeof first);
        memcpy(&second, b + byte, sizeof second);
        memcpy(a + byte, &second, sizeof second);
        memcpy(b + byte, &first, sizeof first);
    }
    for (; byte < h->size; ++byte) {
        const unsigned char kept = a[byte];
        a[byte] = b[byte];
        b[byte] = kept;
    }
}

static int order(const heap *h, size_t i, size_t k)
{
    return h->compare(h->items + h->size * i, h->items + h->size * k);
}

/* Lets an item sink among the first n until no item below it is greater. */
static void sink(const heap *h, size_t i, size_t n)
{
    for (size_t child; (child = 2 * i + 1) < n; i = child) {
        if (child + 1 < n && order(h, child, child + 1) < 0)
            ++child;
        if (order(h, i, child) >= 0)
            return;
        exchange(h, i, child);
    }
}

void iccp_sort_begin(void *items, size_t n, size_t size, int (*compare)(const void *, const void *))
{
    const heap h = {items, size, compare};
    for (size_t i = n / 2; i-- > 0;)
        sink(&h, i, n);
}

void iccp_sort_next(void *items, size_t n, size_t size, int (*compare)(const void *, const void *))
{
    const heap h = {items, size, compare};
    exchange(&h, 0, n - 1);
    sink(&h, 0, n - 1);
}

void iccp_sort(void *items, size_t n, size_t size, int (*compare)(const void *, const void *))
{
    iccp_sort_begin(items, n, size, compare);
    for (; n > 1; --n)
        iccp_sort_next(items, n, size, compare);
}

void iccp_list_groups(uint32_t *groups, uint32_t *first, size_t n_keys, const uint32_t *keys,
                      size_t n, size_t size)
{
    for (size_t i = 0; i < size * n; ++i)
        ++first[keys[i]];
    for (size_t k = 0; k < n_keys; ++k)
        first[k + 1] += first[k];
    for (size_t group = n; group-- > 0;)
        for (size_t i = size * group; i < size * (group + 1); ++i)
            groups[--first[keys[i]]] = (uint32_t)group;
}

/* One pass of a radix sort. */
static void sort_by_digit(uint64_t *to, const uint64_t *from, size_t n, int shift)
{
    const uint64_t mask = (1u << DIGIT_BITS) - 1;
    size_t start[(1 << DIGIT_BITS) + 1] = {0};
    for (size_t i = 0; i < n; ++i)
        ++start[(from[i] >> shift & mask) + 1];
    for (size_t digit = 0; digit < mask; ++digit)
        start[digit + 1] += start[digit];
    for (size_t i = 0; i < n; ++i)
        to[start[from[i] >> shift & mask]++] = from[i];
}

/* Least significant digit first. Four passes leave the sorted keys in the original array. */
void iccp_sort_keys(uint64_t *keys, uint64_t *work, size_t n, int shift)
{
    sort_by_digit(work, keys, n, shift);
    sort_by_digit(keys, work, n, shift + DIGIT_BITS);
    sort_by_digit(work, keys, n, shift + 2 * DIGIT_BITS);
    sort_by_digit(keys, work, n, shift + 3 * DIGIT_BITS);
}

double iccp_select(double *x, size_t n, size_t k)
{
    size_t low = 0, high = n - 1;
    while (low < high) {
        const double pivot = x[low + (high - low) / 2];
        size_t i = low, j = high;
        while (true) {
            while (x[i] < pivot)
                ++i;
            while (x[j] > pivot)
                --j;
            if (i >= j)
                break;
            const double other = x[i];
            x[i++] = x[j];
            x[j--] = other;
        }
        if (k <= j)
            high = j;
        else
            low = j + 1;
    }
    return x[k];
}
