/* A set of small numbers from which the smallest can be taken. */
#ifndef ICCP_QUEUE_H
#define ICCP_QUEUE_H

#include "base/memory.h"

#include <stdint.h>

enum { ICCP_QUEUE_LEVELS = 6 }; /* 64^6 > 2^32 */

/* Bit i of level 0 stands for the number i. Bit i of any other level tells whether word i of the
 * level below has a bit set. */
typedef struct iccp_queue {
    uint64_t *level[ICCP_QUEUE_LEVELS];
    int n_levels;
} iccp_queue;

/* Makes an empty set for numbers below n. level[0] is NULL if there is no memory. */
void iccp_queue_create(iccp_queue *queue, size_t n, const iccp_memory *memory);
void iccp_queue_free(iccp_queue *queue, const iccp_memory *memory);

/* Adds a number, which may be there already. */
static inline void iccp_queue_push(iccp_queue *queue, uint32_t number)
{
    for (int k = 0; k < queue->n_levels; ++k) {
        uint64_t *word = &queue->level[k][number / 64];
        const uint64_t before = *word;
        *word |= (uint64_t)1 << (number % 64);
        if (before != 0)
            return;
        number /= 64;
    }
}

/* Removes and returns the smallest number, or UINT32_MAX if there is none. */
uint32_t iccp_queue_pop(iccp_queue *queue);

#endif
