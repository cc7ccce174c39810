/* Pairs items of two layers that have the same key, such as nodes with the same regions around
 * them. Among several with one key, the least sum of squared distances decides. */
#ifndef ICCP_ALIKE_H
#define ICCP_ALIKE_H

#include "match/assignment.h"

/* An item: the words [first, first + n) of a list are its key. */
typedef struct iccp_alike {
    size_t first;
    uint32_t n;
    iccp_spot spot; /* spot.number is the item's number */
} iccp_alike;

typedef struct iccp_alikes {
    size_t n, n_words;
    iccp_alike *item;
    uint32_t *word;
} iccp_alikes;

/* Sorts the items by their keys, which the other functions rely on. */
icc_status iccp_alike_sort(iccp_alikes *items, const iccp_memory *memory);

/* Sets partner[a's number] = b's number for items that are the only ones with their key in both
 * layers. */
void iccp_alike_sure(uint32_t *partner, const iccp_alikes *a, const iccp_alikes *b);

/* Does the same for keys with several items, by their spots. Adds the number of pairs to
 * *n_settled. Items that are left over keep what `partner` says. */
icc_status iccp_alike_settle(uint32_t *partner, const iccp_alikes *a, const iccp_alikes *b,
                             size_t *n_settled, const iccp_env *env);

#endif
