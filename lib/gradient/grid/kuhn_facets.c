/* The facets of the Kuhn triangulation. Based on: H. Freudenthal, Simplizialzerlegungen von
 * beschraenkter Flachheit, Annals of Mathematics 43, 1942.
 *
 * The corners of a simplex are a chain: each lies one step along a new axis above the one before.
 * Without the highest corner, the rest is a facet that the simplex shares with one of the cell
 * behind the last axis. Without a corner in the middle, it is a facet that the simplex shares with
 * the one that takes the two steps there in the other order. */
#include "gradient/grid/kuhn_facets.h"

static size_t count_facets(int32_t dim)
{
    size_t n = 1;
    for (int32_t k = 2; k <= dim; ++k)
        n *= (size_t)k;
    return n * (size_t)(dim + 1) / 2;
}

/* Adds all chains that continue from a corner. They go to corner `turn` by single steps, and end
 * there unless `pair` is a set of two axes. Then they take both in one step, and go on to the
 * highest corner of the cell. */
static void add_chains(iccp_kuhn_facets *f, unsigned highest, unsigned turn, unsigned pair,
                       unsigned corner, uint64_t chain)
{
    chain |= (uint64_t)1 << corner;
    if (corner == (pair != 0 ? highest : turn)) {
        f->facet[f->n++] = chain;
        return;
    }
    if (corner == turn) {
        add_chains(f, highest, turn, pair, corner | pair, chain);
        return;
    }
    const unsigned left = ((corner & ~turn) == 0 ? turn : highest) & ~corner;
    for (unsigned axis = 1; axis <= left; axis <<= 1)
        if (left & axis)
            add_chains(f, highest, turn, pair, corner | axis, chain);
}

/* One for each axis, and one for each 2-D face of the cell that contains its own lowest corner. */
static size_t count_groups(int32_t dim)
{
    return (size_t)dim + ((size_t)1 << dim) * (size_t)dim * (size_t)(dim - 1) / 8;
}

static void add_group(iccp_kuhn_facets *f, unsigned highest, unsigned turn, unsigned pair,
                      const iccp_facet_group *slots)
{
    iccp_facet_group *group = &f->group[f->n_groups++];
    *group = *slots;
    group->first = f->n;
    add_chains(f, highest, turn, pair, 0, 0);
    group->end = f->n;
}

/* Adds the facets in the border of the cell behind which axis k leads to another cell. */
static void add_between_cells(iccp_kuhn_facets *f, unsigned highest, int32_t k)
{
    const unsigned turn = highest & ~(1u << k);
    const uint8_t top = (uint8_t)highest, back = (uint8_t)(highest + 1 + (unsigned)k);
    const iccp_facet_group slots = {
        .apex = {top, back}, .before = {(uint8_t)turn, back}, .after = {top, 0}};
    add_group(f, highest, turn, 0, &slots);
}

/* Adds the facets that have a diagonal of one of the cell's 2-D faces: from corner `turn`, along
 * axes a and b. */
static void add_within_cell(iccp_kuhn_facets *f, unsigned highest, unsigned turn, unsigned a,
                            unsigned b)
{
    const uint8_t from = (uint8_t)turn, to = (uint8_t)(turn | a | b);
    const iccp_facet_group slots = {.apex = {(uint8_t)(turn | a), (uint8_t)(turn | b)},
                                    .before = {from, from},
                                    .after = {to, to}};
    add_group(f, highest, turn, a | b, &slots);
}

icc_status iccp_kuhn_facets_create(iccp_kuhn_facets *facets, int32_t dim, const iccp_memory *memory)
{
    const unsigned highest = (1u << dim) - 1;
    *facets = (iccp_kuhn_facets){0};
    facets->facet = iccp_alloc(memory, count_facets(dim), sizeof *facets->facet);
    facets->group = iccp_alloc(memory, count_groups(dim), sizeof *facets->group);
    if (facets->facet == NULL || facets->group == NULL)
        return ICC_ERR_MEMORY;
    for (int32_t k = dim; k-- > 0;)
        add_between_cells(facets, highest, k);
    for (unsigned turn = 0; turn <= highest; ++turn)
        for (unsigned b = 2; b <= highest; b <<= 1)
            for (unsigned a = 1; a < b; a <<= 1)
                if ((turn & (a | b)) == 0)
                    add_within_cell(facets, highest, turn, a, b);
    return ICC_OK;
}

void iccp_kuhn_facets_free(iccp_kuhn_facets *facets, const iccp_memory *memory)
{
    iccp_free(memory, facets->facet);
    iccp_free(memory, facets->group);
}
