/* Orders the sides around each place by exact signs, and follows borders from node to node. */
#include "match/coverage/layer_graph.h"

#include "base/error.h"
#include "base/sort.h"
#include "geometry/segment.h"
#include "match/coverage/layer_check.h"
#include "math/predicates.h"

#include <string.h>

void iccp_layer_graph_free(iccp_layer_graph *graph, const iccp_memory *memory)
{
    iccp_free(memory, graph->first);
    iccp_free(memory, graph->leaving);
    iccp_free(memory, graph->border);
    iccp_free(memory, graph->at);
    iccp_free(memory, graph->course);
}

/* Orders half-sides that leave one place counter-clockwise from direction (0, -1), which is
 * excluded. */
static bool is_before(const void *context, uint32_t a, uint32_t b)
{
    const iccp_layer *const layer = context;
    const double *const v = layer->place + 2 * (size_t)iccp_half_from(layer, a);
    const double *const p = layer->place + 2 * (size_t)iccp_half_from(layer, a ^ 1);
    const double *const q = layer->place + 2 * (size_t)iccp_half_from(layer, b ^ 1);
    const bool is_forward = iccp_point_less(v, p);
    return is_forward != iccp_point_less(v, q) ? is_forward : iccp_orient2d(v, p, q) > 0;
}

/* Lists the half-sides around each place in order. `work` has room for all half-sides. */
static void order(iccp_layer_graph *graph, uint32_t *work)
{
    const iccp_layer *const layer = graph->layer;
    for (uint32_t h = 0; h < 2 * layer->n_sides; ++h)
        ++graph->first[iccp_half_from(layer, h) + 1];
    for (size_t v = 0; v < layer->n; ++v)
        graph->first[v + 1] += graph->first[v];
    for (uint32_t h = (uint32_t)(2 * layer->n_sides); h-- > 0;)
        graph->leaving[--graph->first[iccp_half_from(layer, h) + 1]] = h;
    memmove(graph->first, graph->first + 1, layer->n * sizeof *graph->first);
    graph->first[layer->n] = (uint32_t)(2 * layer->n_sides);
    for (uint32_t v = 0; v < layer->n; ++v)
        iccp_sort_indices(graph->leaving + graph->first[v], work, iccp_graph_degree(graph, v),
                          layer, is_before);
}

/* Checks that the regions around each place agree from side to side. */
static icc_status check(const iccp_layer_graph *graph, icc_error *err)
{
    const iccp_layer *const layer = graph->layer;
    for (uint32_t v = 0; v < layer->n; ++v) {
        const uint32_t *const h = graph->leaving + graph->first[v];
        const uint32_t n = iccp_graph_degree(graph, v);
        const double *const at = layer->place + 2 * (size_t)v;
        for (uint32_t k = 0; k < n; ++k) {
            const uint32_t next = h[(k + 1) % n];
            const uint32_t a = iccp_half_left(layer, h[k]), b = iccp_half_left(layer, next ^ 1);
            if (a != b)
                return iccp_layer_overlap(layer, a, b, at, err);
            if (k + 1 < n && !is_before(layer, h[k], next))
                return iccp_layer_overlap(layer, iccp_half_left(layer, h[k] ^ 1),
                                          iccp_half_left(layer, next), at, err);
        }
    }
    return ICC_OK;
}

/* Follows one border from half-side h on. `end` is where the places along all borders end. */
static size_t follow(iccp_layer_graph *graph, uint32_t h, size_t end)
{
    const iccp_layer *const layer = graph->layer;
    const uint32_t number = (uint32_t)graph->n_borders++, start = iccp_half_from(layer, h);
    iccp_border *const border = &graph->border[number];
    *border = (iccp_border){.first = end, .half = {h, h}};
    border->region[0] = iccp_half_left(layer, h);
    border->region[1] = iccp_half_left(layer, h ^ 1);
    graph->at[end++] = start;
    for (;;) {
        const uint32_t to = iccp_half_from(layer, h ^ 1);
        graph->at[end++] = to;
        graph->course[h] = 2 * number;
        graph->course[h ^ 1] = 2 * number + 1;
        border->half[1] = h ^ 1;
        ++border->n;
        if (to == start || iccp_graph_is_node(graph, to))
            break;
        const uint32_t *const leaving = graph->leaving + graph->first[to];
        h = leaving[leaving[0] == (h ^ 1) ? 1 : 0];
    }
    border->is_island = !iccp_graph_is_node(graph, start);
    graph->n_islands += border->is_island;
    return end;
}

/* Finds all borders: first those that begin at nodes, then the islands. */
static void find_borders(iccp_layer_graph *graph)
{
    const iccp_layer *const layer = graph->layer;
    size_t end = 0;
    memset(graph->course, 0xff, 2 * layer->n_sides * sizeof *graph->course);
    for (int round = 0; round < 2; ++round)
        for (uint32_t h = 0; h < 2 * layer->n_sides; ++h) {
            const bool is_begin = iccp_graph_is_node(graph, iccp_half_from(layer, h));
            if (graph->course[h] == UINT32_MAX && (is_begin || round == 1) &&
                iccp_half_left(layer, h) < iccp_half_left(layer, h ^ 1))
                end = follow(graph, h, end);
        }
    for (uint32_t v = 0; v < layer->n; ++v)
        graph->n_nodes += iccp_graph_is_node(graph, v);
}

icc_status iccp_layer_graph_create(iccp_layer_graph *graph, const iccp_layer *layer,
                                   const iccp_env *env, icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    const size_t n = layer->n_sides;
    *graph = (iccp_layer_graph){.layer = layer};
    graph->first = iccp_alloc_zero(memory, layer->n + 1, sizeof *graph->first);
    graph->leaving = iccp_alloc(memory, n, 2 * sizeof *graph->leaving);
    graph->border = iccp_alloc(memory, n, sizeof *graph->border);
    graph->at = iccp_alloc(memory, n, 2 * sizeof *graph->at);
    graph->course = iccp_alloc(memory, n, 2 * sizeof *graph->course);
    if (graph->first == NULL || graph->leaving == NULL || graph->border == NULL ||
        graph->at == NULL || graph->course == NULL)
        return iccp_fail_memory(err);
    order(graph, graph->course);
    icc_status status = check(graph, err);
    if (status == ICC_OK)
        status = iccp_layer_check(graph, env, err);
    if (status == ICC_OK)
        find_borders(graph);
    return status;
}
