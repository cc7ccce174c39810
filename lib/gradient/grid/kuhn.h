/* Links of the Kuhn (Freudenthal) triangulation of a grid, in any dimension up to ICC_MAX_DIM.
 * Every cell is cut along its diagonals from lower to upper corners. Two vertices are joined if
 * they differ by 0s and 1s only, or by 0s and -1s only. */
#ifndef ICCP_KUHN_H
#define ICCP_KUHN_H

#include "icc/base.h"

#include <stdbool.h>

enum {
    ICCP_LINK_SIZE = 126,     /* neighbours of a vertex in ICC_MAX_DIM dimensions: 2 (2^6 - 1) */
    ICCP_LINK_TABLE = 1 << 14 /* number of sets of the 14 neighbours in 3-D */
};

/* A set of neighbours: bit i of word[i / 64] is for neighbour i. */
typedef struct iccp_link_set {
    uint64_t word[2];
} iccp_link_set;

typedef struct iccp_kuhn {
    int32_t dim;
    int n_neighbours;                         /* 2 (2^dim - 1) */
    int8_t step[ICCP_LINK_SIZE][ICC_MAX_DIM]; /* to each neighbour */
    iccp_link_set all;
    iccp_link_set joined[ICCP_LINK_SIZE]; /* neighbour i and the neighbours joined to it */
    bool tabulated;
    uint64_t regular[ICCP_LINK_TABLE / 64]; /* answers for all sets, after iccp_kuhn_tabulate() */
} iccp_kuhn;

void iccp_kuhn_init(iccp_kuhn *kuhn, int32_t dim);

/* Computes the answers for all sets in advance. This pays for more than about 2^n_neighbours
 * queries. Takes 1 ms up to 3-D, and has no effect in higher dimensions. */
void iccp_kuhn_tabulate(iccp_kuhn *kuhn);

static inline void iccp_link_add(iccp_link_set *set, int i)
{
    set->word[i / 64] |= (uint64_t)1 << (i % 64);
}

static inline bool iccp_link_has(const iccp_link_set *set, int i)
{
    return set->word[i / 64] >> (i % 64) & 1;
}

static inline bool iccp_link_is_empty(const iccp_link_set *set)
{
    return (set->word[0] | set->word[1]) == 0;
}

/* Returns the neighbours that are not in a set. */
static inline iccp_link_set iccp_link_rest(const iccp_kuhn *kuhn, const iccp_link_set *set)
{
    return (iccp_link_set){{kuhn->all.word[0] & ~set->word[0], kuhn->all.word[1] & ~set->word[1]}};
}

/* Returns true if a set of neighbours and its complement each span a contractible part of the link.
 * Exact up to 3-D. In higher dimensions true is exact, and false may mean that no proof was
 * found. */
bool iccp_kuhn_regular(const iccp_kuhn *kuhn, const iccp_link_set *set);

#endif
