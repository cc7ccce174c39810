/* Checks a layer by one sweep (geometry/graph_sweep.h). It finds sides that cross. For each part of
 * the graph it also finds the side below its first place. The region on that side must be the one
 * that the part has around it. */
#include "match/coverage/layer_check.h"

#include "base/error.h"
#include "geometry/graph_sweep.h"
#include "geometry/point_order.h"
#include "geometry/segment.h"

#include <inttypes.h>

typedef struct checking {
    const iccp_layer_graph *graph;
    uint32_t *node, *work;
    uint32_t *end;  /* of each side: its two places */
    int32_t *count; /* of each side: what the sweep counts, here nothing, and the sums: all 0 */
    uint32_t *below;
} checking;

static const double *place_of(const checking *c, uint32_t v)
{
    return c->graph->layer->place + 2 * (size_t)v;
}

/* Reports two sides that meet. Regions that differ claim the same places. */
static icc_status fail_meeting(const checking *c, const iccp_graph_defect *found, icc_error *err)
{
    const iccp_layer *const layer = c->graph->layer;
    const iccp_layer_side *const s = &layer->side[found->a], *const t = &layer->side[found->b];
    uint32_t a = ICCP_NO_REGION, b = ICCP_NO_REGION;
    for (int k = 0; k < 4 && (b == ICCP_NO_REGION || a == b); ++k)
        if (s->region[k / 2] != ICCP_NO_REGION && t->region[k % 2] != ICCP_NO_REGION) {
            a = s->region[k / 2];
            b = t->region[k % 2];
        }
    double at[2];
    iccp_segments_point(place_of(c, s->end[0]), place_of(c, s->end[1]), place_of(c, t->end[0]),
                        place_of(c, t->end[1]), at);
    return iccp_layer_overlap(layer, a, b, at, err);
}

/* Compares what a part of the graph has around it with the region where it lies. */
static icc_status check_around(const checking *c, uint32_t v, icc_error *err)
{
    const iccp_layer *const layer = c->graph->layer;
    const uint32_t *const leaving = c->graph->leaving;
    const uint32_t first = leaving[c->graph->first[v]], last = leaving[c->graph->first[v + 1] - 1];
    if (!iccp_point_less(place_of(c, v), place_of(c, iccp_half_from(layer, last ^ 1))))
        return ICC_OK;
    const uint32_t around = iccp_half_left(layer, last), below = c->below[v];
    const uint32_t there = below == ICCP_NO_HALF ? ICCP_NO_REGION : iccp_half_left(layer, below);
    if (around == there)
        return ICC_OK;
    if (around == ICCP_NO_REGION)
        return iccp_layer_overlap(layer, there, iccp_half_left(layer, first), place_of(c, v), err);
    double at[2];
    iccp_layer_given(layer, v, at);
    return iccp_fail(err, ICC_ERR_BOUNDARY,
                     "a hole of region %" PRId64 " lies outside it at (%.9g, %.9g)",
                     layer->regions->id[around], at[0], at[1]);
}

static icc_status run(const checking *c, const iccp_env *env, icc_error *err)
{
    const iccp_layer_graph *const g = c->graph;
    const iccp_layer *const layer = g->layer;
    iccp_graph_defect found = {0};
    size_t n = 0;
    for (size_t s = 0; s < layer->n_sides; ++s)
        for (size_t k = 0; k < 2; ++k)
            c->end[2 * s + k] = layer->side[s].end[k];
    for (uint32_t v = 0; v < layer->n; ++v)
        if (iccp_graph_degree(g, v) > 0)
            c->node[n++] = v;
    iccp_order_points(c->node, c->work, n, layer->place);
    const iccp_graph graph = {layer->place, c->end,   layer->n_sides, n,
                              c->node,      g->first, g->leaving,     c->count};
    icc_status status =
        iccp_explain(err, iccp_graph_sweep(&found, &graph, c->count, c->below, env));
    if (status == ICC_OK && found.kind != 0)
        status = fail_meeting(c, &found, err);
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        status = check_around(c, c->node[k], err);
    return status;
}

icc_status iccp_layer_check(const iccp_layer_graph *graph, const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = graph->layer->n, n_sides = graph->layer->n_sides;
    const checking c = {.graph = graph,
                        .node = iccp_alloc(memory, n, sizeof *c.node),
                        .work = iccp_alloc(memory, n, sizeof *c.work),
                        .end = iccp_alloc(memory, n_sides, 2 * sizeof *c.end),
                        .count = iccp_alloc_zero(memory, n_sides, sizeof *c.count),
                        .below = iccp_alloc(memory, n, sizeof *c.below)};
    const bool has_all =
        c.node != NULL && c.work != NULL && c.end != NULL && c.count != NULL && c.below != NULL;
    const icc_status status = has_all ? run(&c, env, err) : iccp_fail_memory(err);
    iccp_free(memory, c.node);
    iccp_free(memory, c.work);
    iccp_free(memory, c.end);
    iccp_free(memory, c.count);
    iccp_free(memory, c.below);
    return status;
}
