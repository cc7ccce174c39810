/* Heapsort: J. W. J. Williams, Algorithm 232, 1964; R. W. Floyd, Algorithm 245, 1964. */
#include "base/sort.h"

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

/* Lets an item sink among the first n until none below it is greater. */
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

void iccp_sort(void *items, size_t n, size_t size, int (*compare)(const void *, const void *))
{
    const heap h = {items, size, compare};
    for (size_t i = n / 2; i-- > 0;)
        sink(&h, i, n);
    for (size_t last = n; last-- > 1;) {
        exchange(&h, 0, last);
        sink(&h, 0, last);
    }
}
