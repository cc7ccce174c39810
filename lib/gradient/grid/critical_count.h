/* Critical vertices of an order of the vertices of a grid, whatever it comes from.
 *
 * Based on: T. Banchoff, Critical Points and Curvature for Embedded Polyhedra, Journal of
 * Differential Geometry 1, 1967: what a piecewise linear function does at a vertex can be read off
 * the neighbours that are higher and those that are lower. */
#ifndef ICCP_CRITICAL_COUNT_H
#define ICCP_CRITICAL_COUNT_H

#include "base/threads.h"
#include "gradient/grid/star.h"

/* A count on its way. */
typedef struct iccp_critical {
    iccp_star star;
    const void *context;          /* the order: for the two questions below */
    uint32_t highest;             /* where a maximum is expected */
    icc_function_report *partial; /* what each chunk found */
} iccp_critical;

/* Whether a vertex takes part in the order; those that do not are lower than all others. */
typedef bool (*iccp_is_ranked)(const void *context, uint32_t v);

/* Of two that do. */
typedef bool (*iccp_is_higher)(const void *context, uint32_t u, uint32_t v);

/* Counts critical vertices; see icc_function_report, of which all but `size` is filled in. `chunk`
 * calls iccp_critical_chunk() with the two questions; it is asked from several threads at a time.
 * `n_ranked`: about how many take part. ICC_ERR_MEMORY or ICC_ERR_CANCELLED leave the report as it
 * was. */
icc_status iccp_critical_count(const icc_grid *grid, const void *context, size_t n_ranked,
                               uint32_t highest, iccp_chunk chunk, icc_function_report *report,
                               const iccp_env *env);

/* Files what a chunk that begins there has found. */
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

/* Inlined, so that the two questions cost no calls. */
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
