/* Counts the critical vertices of an order of a grid's vertices.
 *
 * Based on: T. Banchoff, Critical Points and Curvature for Embedded Polyhedra, Journal of
 * Differential Geometry 1, 1967. What a piecewise linear function does at a vertex follows from
 * which neighbours are higher and which are lower. */
#ifndef ICCP_CRITICAL_COUNT_H
#define ICCP_CRITICAL_COUNT_H

#include "base/threads.h"
#include "gradient/grid/star.h"

/* State of a count. */
typedef struct iccp_critical {
    iccp_star star;
    const void *context;          /* the order, for the two functions below */
    uint32_t highest;             /* the expected maximum */
    icc_function_report *partial; /* result of each chunk */
} iccp_critical;

/* Returns true if a vertex takes part in the order. Vertices that do not are lower than all
 * others. */
typedef bool (*iccp_is_ranked)(const void *context, uint32_t v);

/* Returns true if u is higher than v. Both take part. */
typedef bool (*iccp_is_higher)(const void *context, uint32_t u, uint32_t v);

/* Counts critical vertices and fills in an icc_function_report except `size`. `chunk` calls
 * iccp_critical_chunk() with the two functions above, from several threads at a time. `n_ranked` is
 * about the number of vertices that take part. ICC_ERR_MEMORY and ICC_ERR_CANCELLED leave the
 * report unchanged. */
icc_status iccp_critical_count(const icc_grid *grid, const void *context, size_t n_ranked,
                               uint32_t highest, iccp_chunk chunk, icc_function_report *report,
                               const iccp_env *env);

/* Stores the result of the chunk that begins at `begin`. */
void iccp_critical_put(const iccp_critical *count, size_t begin, const icc_function_report *found);

static ICCP_INLINE iccp_link_set iccp_critical_higher(const iccp_critical *c, uint32_t v,
                                                      iccp_is_ranked ranked, iccp_is_higher higher)
{
    const iccp_link_set within =
        iccp_star_is_cut(&c->star, v) ? iccp_star_within(&c->star, v) : c->star.kuhn.all;
    iccp_link_set set = {{0, 0}};
    for (int i = 0; i < c->star.kuhn.n_neighbours; ++i) {
        if (!iccp_link_has(&within, i))
            continue;
        const uint32_t u = iccp_star_vertex(&c->star, v, i);
        if (ranked(c->context, u) && higher(c->context, u, v))
            iccp_link_add(&set, i);
    }
    return set;
}

/* Inlined, so that the two functions cost no calls. */
static ICCP_INLINE icc_status iccp_critical_chunk(const iccp_critical *c, size_t begin, size_t end,
                                                  iccp_is_ranked ranked, iccp_is_higher higher)
{
    icc_function_report found = {.critical = ICCP_NONE};
    for (uint32_t v = (uint32_t)begin; v < end; ++v) {
        if (!ranked(c->context, v))
            continue;
        const iccp_link_set above = iccp_critical_higher(c, v, ranked, higher);
        const iccp_link_set below = iccp_link_rest(&c->star.kuhn, &above);
        if (iccp_link_is_empty(&above))
            ++found.n_maxima;
        else if (iccp_link_is_empty(&below))
            ++found.n_minima;
        else if (!iccp_kuhn_regular(&c->star.kuhn, &above))
            ++found.n_saddles;
        else
            continue;
        if (found.critical == ICCP_NONE && v != c->highest)
            found.critical = v;
    }
    iccp_critical_put(c, begin, &found);
    return ICC_OK;
}

#endif
