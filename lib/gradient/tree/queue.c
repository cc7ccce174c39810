/* A set of small numbers. Based on: P. van Emde Boas, Preserving Order in a Forest in Less than
 * Logarithmic Time, 1975, as a tree of machine words with 64 children each. */
#include "gradient/tree/queue.h"

void iccp_queue_create(iccp_queue *queue, size_t n, const iccp_memory *memory)
{
    size_t total = 0, count = n;
    queue->n_levels = 0;
    do {
        count = (count + 63) / 64;
        total += count;
        ++queue->n_levels;
    } while (count > 1);
    uint64_t *words = iccp_alloc_zero(memory, total, sizeof *words);
    for (int k = 0; k < queue->n_levels; ++k) {
        n = (n + 63) / 64;
        queue->level[k] = words;
        words = words != NULL ? words + n : NULL;
    }
}

void iccp_queue_free(iccp_queue *queue, const iccp_memory *memory)
{
    iccp_free(memory, queue->level[0]);
    queue->level[0] = NULL;
}

/* Returns the number of the lowest bit that is set in a word other than 0. */
static uint32_t lowest_bit(uint64_t word)
{
    uint32_t at = 0;
    for (uint32_t half = 32; half > 0; half /= 2)
        if (word << (64 - half) == 0) {
            word >>= half;
            at += half;
        }
    return at;
}

uint32_t iccp_queue_pop(iccp_queue *queue)
{
    uint32_t at = 0;
    if (queue->level[queue->n_levels - 1][0] == 0)
        return UINT32_MAX;
    for (int k = queue->n_levels; k-- > 0;)
        at = 64 * at + lowest_bit(queue->level[k][at]);
    uint32_t number = at;
    for (int k = 0; k < queue->n_levels; ++k) {
        uint64_t *word = &queue->level[k][number / 64];
        *word &= ~((uint64_t)1 << (number % 64));
        if (*word != 0)
            break;
        number /= 64;
    }
    return at;
}
