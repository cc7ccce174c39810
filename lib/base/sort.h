/* Sorting without memory of its own, which qsort() may take. */
#ifndef ICCP_SORT_H
#define ICCP_SORT_H

#include <stddef.h>

/* As qsort(), NULL being fine for no items. Of equal items any may come first. O(n log n). */
void iccp_sort(void *items, size_t n, size_t size, int (*compare)(const void *, const void *));

#endif
