/* Priority queue of numbers whose keys may change. The smallest key comes out first. */
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
    uint32_t *place; /* place of each number among the entries; UINT32_MAX: not in the queue */
} iccp_heap;

/* Makes an empty queue for numbers below n. Returns false if memory is missing; free the queue in
 * either case. */
bool iccp_heap_create(iccp_heap *heap, size_t n, const iccp_memory *memory);
void iccp_heap_free(iccp_heap *heap, const iccp_memory *memory);

/* Removes all numbers. */
void iccp_heap_clear(iccp_heap *heap);

/* Inserts a number, or changes its key. O(log n). */
void iccp_heap_put(iccp_heap *heap, uint32_t number, double key);

/* Removes and returns the number with the smallest key; among equal keys, the smallest number. The
 * queue must not be empty. O(log n). */
uint32_t iccp_heap_pop(iccp_heap *heap);

#endif
