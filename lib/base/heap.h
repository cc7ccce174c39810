/* A queue of numbers with keys that may change, which gives out the one with the smallest key. */
#ifndef ICCP_HEAP_H
#define ICCP_HEAP_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct iccp_heap_entry {
    double key;
    uint32_t number;
} iccp_heap_entry;

typedef struct iccp_heap {
    size_t n_entries;
    iccp_heap_entry *entry;
    uint32_t *place; /* of each number among the entries; UINT32_MAX: it is not there */
} iccp_heap;

/* For numbers below n; empty. False if there is no memory, to be freed all the same. */
bool iccp_heap_create(iccp_heap *heap, size_t n, const iccp_memory *memory);
void iccp_heap_free(iccp_heap *heap, const iccp_memory *memory);

/* Takes everything out. */
void iccp_heap_clear(iccp_heap *heap);

/* Takes in a number, or gives it another key. O(log n). */
void iccp_heap_put(iccp_heap *heap, uint32_t number, double key);

/* Takes out the number with the smallest key; of equal ones, the smallest number. The heap is not
 * empty. O(log n). */
uint32_t iccp_heap_pop(iccp_heap *heap);

#endif
