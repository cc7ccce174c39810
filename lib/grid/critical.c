/* Based on: T. Banchoff, Critical Points and Curvature for Embedded Polyhedra, Journal of Differential
 * Geometry 1, 1967: what a piecewise linear function does at a vertex can be read off the neighbours
 * that are higher and those that are lower. */
#include "grid/critical.h"

#include "base/threads.h"

static const size_t GRAIN = 1 << 12; /* vertices per chunk: at most 0.4 s, in 6-D */

typedef struct work {
    const iccp_ordering *ordering;
    iccp_star star;
    icc_field_report *partial; /* what each chunk found */
} work;

static iccp_link_set higher_neighbours(const work *w, uint32_t v)
{
    const iccp_ordering *o = w->ordering;
    const iccp_link_set within =
        iccp_star_is_cut(&w->star, v) ? iccp_star_within(&w->star, v) : w->star.kuhn.all;
    iccp_link_set higher = {{0, 0}};
    for (int i = 0; i < w->star.kuhn.n_neighbours; ++i) {
        if (!iccp_link_has(&within, i))
            continue;
        const uint32_t u = iccp_star_vertex(&w->star, v, i);
        if (o->ranked(o->context, u) && o->is_higher(o->context, u, v))
            iccp_link_add(&higher, i);
    }
    return higher;
}

static void judge(const work *w, uint32_t v, icc_field_report *report)
{
    const iccp_link_set higher = higher_neighbours(w, v);
    const iccp_link_set lower = iccp_link_rest(&w->star.kuhn, &higher);
    if (iccp_link_is_empty(&higher))
        ++report->n_maxima;
    else if (iccp_link_is_empty(&lower))
        ++report->n_minima;
    else if (!iccp_kuhn_regular(&w->star.kuhn, &higher))
        ++report->n_saddles;
    else
        return;
    if (report->critical == ICCP_NONE && v != w->ordering->highest)
        report->critical = v;
}

static icc_status judge_chunk(void *argument, size_t begin, size_t end)
{
    const work *w = argument;
    icc_field_report report = {.critical = ICCP_NONE};
    for (uint32_t v = (uint32_t)begin; v < end; ++v)
        if (w->ordering->ranked(w->ordering->context, v))
            judge(w, v, &report);
    w->partial[begin / GRAIN] = report;
    return ICC_OK;
}

icc_status iccp_grid_critical(const icc_grid *grid, const iccp_ordering *ordering,
                              icc_field_report *report, const iccp_env *env)
{
    const size_t n_chunks = (grid->n_vertices + GRAIN - 1) / GRAIN;
    work w = {.ordering = ordering};
    w.partial = iccp_alloc(&env->memory, n_chunks, sizeof *w.partial);
    if (w.partial == NULL)
        return ICC_ERR_MEMORY;
    iccp_star_init(&w.star, grid, ordering->n_ranked);
    const icc_status status =
        iccp_for_chunks(env, "critical points", grid->n_vertices, GRAIN, judge_chunk, &w);
    if (status == ICC_OK) {
        report->n_maxima = report->n_minima = report->n_saddles = 0;
        report->critical = ICCP_NONE;
        report->reserved = 0;
        for (size_t c = n_chunks; c-- > 0;) {
            report->n_maxima += w.partial[c].n_maxima;
            report->n_minima += w.partial[c].n_minima;
            report->n_saddles += w.partial[c].n_saddles;
            if (w.partial[c].critical != ICCP_NONE)
                report->critical = w.partial[c].critical;
        }
    }
    iccp_free(&env->memory, w.partial);
    return status;
}
