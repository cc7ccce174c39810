/* Makes the sides of a layer. The edges of one region that run both ways between two places cancel
 * out: sides that run back, and sides between two parts of the region. What is left has at most
 * one region on its left and one on its right, unless regions overlap. */
#include "match/coverage/layer.h"

#include "base/error.h"
#include "base/sort.h"

static uint32_t low_of(const iccp_layer_edge *e)
{
    return e->from < e->to ? e->from : e->to;
}

static uint32_t high_of(const iccp_layer_edge *e)
{
    return e->from < e->to ? e->to : e->from;
}

/* Orders edges by their two places, then by region. */
static int by_places(const void *a, const void *b)
{
    const iccp_layer_edge *const p = a, *const q = b;
    const uint32_t x[3] = {low_of(p), high_of(p), p->region};
    const uint32_t y[3] = {low_of(q), high_of(q), q->region};
    for (int k = 0; k < 3; ++k)
        if (x[k] != y[k])
            return x[k] < y[k] ? -1 : 1;
    return 0;
}

/* Adds one region to a side: the edges [begin, end) of the same places and region. */
static icc_status add_region(iccp_layer_side *side, const iccp_layer *layer, size_t begin,
                             size_t end, icc_error *err)
{
    const uint32_t region = layer->edge[begin].region;
    long long net = 0;
    for (size_t k = begin; k < end; ++k)
        net += layer->edge[k].from == side->end[0] ? 1 : -1;
    if (net == 0)
        return ICC_OK;
    uint32_t *const to = &side->region[net > 0 ? 0 : 1];
    const uint32_t other = net > 1 || net < -1 ? region : *to;
    if (other != ICCP_NO_REGION)
        return iccp_layer_overlap(layer, region, other, layer->place + 2 * (size_t)side->end[0],
                                  err);
    *to = region;
    return ICC_OK;
}

icc_status iccp_layer_join(iccp_layer *layer, const iccp_env *env, icc_error *err)
{
    icc_status status = ICC_OK;
    const size_t n = layer->n_edges;
    layer->side = iccp_alloc(&env->memory, n, sizeof *layer->side);
    if (layer->side == NULL)
        return iccp_fail_memory(err);
    iccp_sort(layer->edge, n, sizeof *layer->edge, by_places);
    for (size_t k = 0, end; k < n && status == ICC_OK; k = end) {
        const uint32_t low = low_of(&layer->edge[k]), high = high_of(&layer->edge[k]);
        iccp_layer_side side = {{low, high}, {ICCP_NO_REGION, ICCP_NO_REGION}};
        for (end = k; end < n && low_of(&layer->edge[end]) == low &&
                      high_of(&layer->edge[end]) == high && status == ICC_OK;) {
            const size_t begin = end;
            while (end < n && by_places(&layer->edge[begin], &layer->edge[end]) == 0)
                ++end;
            status = add_region(&side, layer, begin, end, err);
        }
        if (side.region[0] != ICCP_NO_REGION || side.region[1] != ICCP_NO_REGION)
            layer->side[layer->n_sides++] = side;
    }
    return status;
}
