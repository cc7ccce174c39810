/* Tests whether sets of neighbours are contractible. Based on: J. A. Barmak and E. G. Minian,
 * Strong Homotopy Types, Nerves and Collapses, Discrete & Computational Geometry 47, 2012.
 *
 * The simplices of the triangulation are the cliques of joined vertices. The link of a vertex is a
 * sphere of one dimension less. Up to 3-D it is two points, a circle or a sphere. There a set and
 * the rest are both contractible if each is connected and not empty (Alexander duality).
 *
 * In higher dimensions the test uses strong collapses. A vertex is dominated by another one if
 * everything joined to it, including itself, is joined to the other. It can then be moved into the
 * other one and dropped without changing the homotopy type. What remains when no vertex is
 * dominated does not depend on the order. So if a set can be reduced to one vertex, any order of
 * drops does it.
 *
 * It is enough that one of the two sets collapses. Its neighbourhood is then a ball, and so is the
 * rest of the sphere (C. P. Rourke and B. J. Sanderson, Introduction to Piecewise-Linear Topology,
 * chapter 3), which shrinks to the other set. */
#include "gradient/grid/kuhn.h"

#include <assert.h>
#include <string.h>

/* Returns true if all members of `part` that are also in `set` are in `whole`. */
static bool covers(const iccp_link_set *whole, const iccp_link_set *part, const iccp_link_set *set)
{
    return (part->word[0] & set->word[0] & ~whole->word[0]) == 0 &&
           (part->word[1] & set->word[1] & ~whole->word[1]) == 0;
}

static void drop(iccp_link_set *set, int i)
{
    set->word[i / 64] &= ~((uint64_t)1 << (i % 64));
}

static bool dominated(const iccp_kuhn *kuhn, const iccp_link_set *set, int i)
{
    for (int j = 0; j < kuhn->n_neighbours; ++j)
        if (j != i && iccp_link_has(set, j) && iccp_link_has(&kuhn->joined[i], j) &&
            covers(&kuhn->joined[j], &kuhn->joined[i], set))
            return true;
    return false;
}

/* Returns a dominated member, or -1. */
static int find_dominated(const iccp_kuhn *kuhn, const iccp_link_set *set, int first)
{
    for (int i = first; i < kuhn->n_neighbours; ++i)
        if (iccp_link_has(set, i) && dominated(kuhn, set, i))
            return i;
    return -1;
}

static bool is_single(const iccp_link_set *set)
{
    const uint64_t a = set->word[0], b = set->word[1];
    return (a == 0 && b != 0 && (b & (b - 1)) == 0) || (b == 0 && a != 0 && (a & (a - 1)) == 0);
}

static bool collapses(const iccp_kuhn *kuhn, iccp_link_set set)
{
    int first = 0;
    if (iccp_link_is_empty(&set))
        return false;
    while (!is_single(&set)) {
        int i = find_dominated(kuhn, &set, first);
        if (i < 0 && first > 0)
            i = find_dominated(kuhn, &set, 0);
        if (i < 0)
            return false;
        drop(&set, i);
        first = i;
    }
    return true;
}

/* Only for sets within the first word. */
static bool is_connected(const iccp_kuhn *kuhn, uint64_t set)
{
    uint64_t reached = set & (~set + 1), before = 0;
    while (reached != before) {
        before = reached;
        for (int i = 0; i < kuhn->n_neighbours; ++i)
            if (before >> i & 1)
                reached |= kuhn->joined[i].word[0] & set;
    }
    return reached == set && set != 0;
}

/* Returns true if two neighbours differ by 0s and 1s only, or by 0s and -1s only. */
static bool are_joined(const iccp_kuhn *kuhn, int i, int j)
{
    int lowest = 0, highest = 0;
    for (int32_t k = 0; k < kuhn->dim; ++k) {
        const int difference = kuhn->step[i][k] - kuhn->step[j][k];
        lowest = difference < lowest ? difference : lowest;
        highest = difference > highest ? difference : highest;
    }
    return highest - lowest <= 1;
}

void iccp_kuhn_init(iccp_kuhn *kuhn, int32_t dim)
{
    assert(dim >= 1 && dim <= ICC_MAX_DIM);
    memset(kuhn, 0, sizeof *kuhn);
    kuhn->dim = dim;
    for (int corner = 1; corner < 1 << dim; ++corner)
        for (int sign = 1; sign >= -1; sign -= 2) {
            for (int32_t k = 0; k < dim; ++k)
                kuhn->step[kuhn->n_neighbours][k] = (int8_t)(sign * (corner >> k & 1));
            ++kuhn->n_neighbours;
        }
    for (int i = 0; i < kuhn->n_neighbours; ++i) {
        iccp_link_add(&kuhn->all, i);
        for (int j = 0; j < kuhn->n_neighbours; ++j)
            if (are_joined(kuhn, i, j))
                iccp_link_add(&kuhn->joined[i], j);
    }
}

static void put(iccp_kuhn *kuhn, uint64_t set)
{
    kuhn->regular[set / 64] |= (uint64_t)1 << (set % 64);
}

/* A set and its complement have the same answer. */
void iccp_kuhn_tabulate(iccp_kuhn *kuhn)
{
    if (kuhn->dim > 3)
        return;
    const uint64_t all = kuhn->all.word[0];
    for (uint64_t set = 0; set <= all / 2; ++set)
        if (is_connected(kuhn, set) && is_connected(kuhn, all - set)) {
            put(kuhn, set);
            put(kuhn, all - set);
        }
    kuhn->tabulated = true;
}

bool iccp_kuhn_regular(const iccp_kuhn *kuhn, const iccp_link_set *set)
{
    const iccp_link_set rest = iccp_link_rest(kuhn, set);
    if (kuhn->tabulated)
        return kuhn->regular[set->word[0] / 64] >> (set->word[0] % 64) & 1;
    if (kuhn->dim <= 3)
        return is_connected(kuhn, set->word[0]) && is_connected(kuhn, rest.word[0]);
    return collapses(kuhn, *set) || collapses(kuhn, rest);
}
