/* Sets of pairs of numbers, as hash tables. */
#ifndef ICCP_PAIRS_H
#define ICCP_PAIRS_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct iccp_pairs {
    iccp_memory memory;
    uint64_t *key;  /* open addressing; the length is a power of two */
    uint32_t *when; /* the round in which each key was added; entries of earlier rounds are empty */
    size_t room, n;
    uint32_t now;
} iccp_pairs;

typedef enum iccp_pair_added { ICCP_PAIR_NEW, ICCP_PAIR_KNOWN, ICCP_PAIR_MEMORY } iccp_pair_added;

/* Adds an unordered pair of different numbers. */
iccp_pair_added iccp_pairs_add(iccp_pairs *pairs, uint32_t a, uint32_t b);
bool iccp_pairs_have(const iccp_pairs *pairs, uint32_t a, uint32_t b);
void iccp_pairs_clear(iccp_pairs *pairs);
void iccp_pairs_free(iccp_pairs *pairs);

#endif
