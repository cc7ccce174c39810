/* Pairs nodes by the regions around them, borders by their nodes and regions, islands by their
 * regions. What is the only one of its kind is sure. An affine map is fitted to that, and then
 * settles the rest by places. */
#include "match/coverage/layer_pairing.h"

#include "match/coverage/alike.h"
#include "match/coverage/layer_affine.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

void iccp_layer_pairing_free(iccp_layer_pairing *pairing, const iccp_memory *memory)
{
    iccp_free(memory, pairing->node);
    iccp_free(memory, pairing->border);
    iccp_free(memory, pairing->back);
}

static icc_status alikes_create(iccp_alikes *items, size_t n, size_t n_words,
                                const iccp_memory *memory)
{
    *items = (iccp_alikes){0};
    items->item = iccp_alloc(memory, n, sizeof *items->item);
    items->word = iccp_alloc(memory, n_words, sizeof *items->word);
    return items->item != NULL && items->word != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static void alikes_free(iccp_alikes *items, const iccp_memory *memory)
{
    iccp_free(memory, items->item);
    iccp_free(memory, items->word);
}

static void add(iccp_alikes *items, iccp_spot spot, const uint32_t *key, uint32_t n)
{
    items->item[items->n++] = (iccp_alike){items->n_words, n, spot};
    memcpy(items->word + items->n_words, key, n * sizeof *key);
    items->n_words += n;
}

/* Returns where the least rotation of a cyclic word begins (Y. Shiloach, Fast canonization of
 * circular strings, 1981). */
static uint32_t least_rotation(const uint32_t *word, uint32_t n)
{
    uint32_t i = 0, j = 1, k = 0;
    while (i < n && j < n && k < n) {
        const uint32_t x = word[(i + k) % n], y = word[(j + k) % n];
        if (x == y) {
            ++k;
            continue;
        }
        if (x > y)
            i += k + 1;
        else
            j += k + 1;
        j += i == j;
        k = 0;
    }
    return i < j ? i : j;
}

/* Lists the nodes of a layer. `work` has room for all half-sides. */
static icc_status list_nodes(iccp_alikes *items, const iccp_layer_graph *graph, uint32_t *work,
                             const iccp_memory *memory)
{
    const iccp_layer *const layer = graph->layer;
    icc_status status = alikes_create(items, graph->n_nodes, 2 * layer->n_sides, memory);
    for (uint32_t v = 0; v < layer->n && status == ICC_OK; ++v) {
        const uint32_t n = iccp_graph_degree(graph, v);
        if (n <= 2)
            continue;
        for (uint32_t k = 0; k < n; ++k)
            work[k] = work[n + k] = iccp_half_left(layer, graph->leaving[graph->first[v] + k]);
        const double *const p = layer->place + 2 * (size_t)v;
        add(items, (iccp_spot){.at = {p[0], p[1]}, .number = v}, work + least_rotation(work, n), n);
    }
    return status == ICC_OK ? iccp_alike_sort(items, memory) : status;
}

/* The centre of an island's line, and the root of its area as a size. *is_left: its left region is
 * inside. */
static iccp_spot island_spot(const iccp_layer_graph *graph, uint32_t number, bool *is_left)
{
    const iccp_border *const border = &graph->border[number];
    const double *const place = graph->layer->place;
    const double *const o = place + 2 * (size_t)graph->at[border->first];
    double length = 0, area = 0, sum[2] = {0, 0};
    for (size_t k = border->first; k < border->first + border->n; ++k) {
        const double *const p = place + 2 * (size_t)graph->at[k];
        const double *const q = place + 2 * (size_t)graph->at[k + 1];
        const double step = iccp_hypot(q[0] - p[0], q[1] - p[1]);
        for (int e = 0; e < 2; ++e)
            sum[e] += step * (p[e] + q[e]) / 2;
        length += step;
        area += (p[0] - o[0]) * (q[1] - o[1]) - (q[0] - o[0]) * (p[1] - o[1]);
    }
    *is_left = area > 0;
    return (iccp_spot){
        .at = {sum[0] / length, sum[1] / length}, .size = sqrt(fabs(area) / 2), .number = number};
}

/* Lists the islands of a layer. */
static icc_status list_islands(iccp_alikes *items, const iccp_layer_graph *graph,
                               const iccp_memory *memory)
{
    icc_status status = alikes_create(items, graph->n_islands, 3 * graph->n_islands, memory);
    for (uint32_t b = 0; b < graph->n_borders && status == ICC_OK; ++b) {
        const iccp_border *const border = &graph->border[b];
        bool is_left = false;
        if (!border->is_island)
            continue;
        const iccp_spot spot = island_spot(graph, b, &is_left);
        add(items, spot, (const uint32_t[]){border->region[0], border->region[1], is_left}, 3);
    }
    return status == ICC_OK ? iccp_alike_sort(items, memory) : status;
}

/* Lists the borders between nodes that have partners. `node`: the target's numbers of the nodes;
 * NULL: they have these numbers. */
static icc_status list_borders(iccp_alikes *items, const iccp_layer_graph *graph,
                               const uint32_t *node, const iccp_memory *memory)
{
    const size_t n = graph->n_borders - graph->n_islands;
    icc_status status = alikes_create(items, n, 4 * n, memory);
    for (uint32_t b = 0; b < graph->n_borders && status == ICC_OK; ++b) {
        const iccp_border *const border = &graph->border[b];
        const uint32_t *const at = graph->at + border->first;
        if (border->is_island)
            continue;
        const uint32_t key[4] = {node != NULL ? node[at[0]] : at[0],
                                 node != NULL ? node[at[border->n]] : at[border->n],
                                 border->region[0], border->region[1]};
        const double *const p = graph->layer->place + 2 * (size_t)at[border->n / 2];
        const double *const q = graph->layer->place + 2 * (size_t)at[(border->n + 1) / 2];
        const iccp_spot spot = {.at = {(p[0] + q[0]) / 2, (p[1] + q[1]) / 2}, .number = b};
        if (key[0] != NONE && key[1] != NONE)
            add(items, spot, key, 4);
    }
    return status == ICC_OK ? iccp_alike_sort(items, memory) : status;
}

/* Moves spots of the source to where the target's should be. */
static void move(iccp_alikes *items, const iccp_plane_affine *affine)
{
    const double *const m = affine->matrix;
    const double scale = sqrt(fabs(m[0] * m[3] - m[1] * m[2]));
    for (size_t k = 0; k < items->n; ++k) {
        iccp_spot *const spot = &items->item[k].spot;
        const double at[2] = {spot->at[0], spot->at[1]};
        iccp_plane_affine_move(affine, at, spot->at);
        spot->size *= scale;
    }
}

/* Appends the places of pairs, four numbers each. `spot` has the target's places by number. */
static size_t collect(double *pairs, size_t n, const iccp_alikes *a, const iccp_alikes *b,
                      const uint32_t *partner, double *spot)
{
    for (size_t k = 0; k < b->n; ++k)
        memcpy(spot + 2 * (size_t)b->item[k].spot.number, b->item[k].spot.at, 2 * sizeof *spot);
    for (size_t k = 0; k < a->n; ++k) {
        const uint32_t other = partner[a->item[k].spot.number];
        if (other == NONE)
            continue;
        memcpy(pairs + 4 * n, a->item[k].spot.at, 2 * sizeof *pairs);
        memcpy(pairs + 4 * n++ + 2, spot + 2 * (size_t)other, 2 * sizeof *pairs);
    }
    return n;
}

/* Fits the affine map to all sure nodes and islands. items: nodes and islands of both layers. */
static icc_status fit(iccp_layer_pairing *pairing, const iccp_alikes *items,
                      const iccp_memory *memory)
{
    const iccp_layer *const layer[2] = {pairing->graph[0]->layer, pairing->graph[1]->layer};
    double *const pairs = iccp_alloc(memory, items[0].n + items[2].n, 4 * sizeof *pairs);
    double *const spot =
        iccp_alloc(memory, layer[1]->n + pairing->graph[1]->n_borders, 2 * sizeof *spot);
    const bool has_all = pairs != NULL && spot != NULL;
    if (has_all) {
        size_t n = collect(pairs, 0, &items[0], &items[1], pairing->node, spot);
        n = collect(pairs, n, &items[2], &items[3], pairing->border, spot);
        iccp_layer_affine_fit(&pairing->affine, n, pairs, layer[0], layer[1]);
    }
    iccp_free(memory, pairs);
    iccp_free(memory, spot);
    return has_all ? ICC_OK : ICC_ERR_MEMORY;
}

static icc_status settle(uint32_t *partner, iccp_layer_pairing *pairing, iccp_alikes *a,
                         const iccp_alikes *b, const iccp_env *env)
{
    move(a, &pairing->affine);
    return iccp_alike_settle(partner, a, b, &pairing->n_settled, env);
}

/* Pairs nodes and islands. */
static icc_status pair_places(iccp_layer_pairing *pairing, uint32_t *work, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    iccp_alikes items[4] = {{0}, {0}, {0}, {0}};
    iccp_env parts[2];
    iccp_split(parts, 2, (const double[]){1, 1}, env);
    icc_status status = ICC_OK;
    for (int e = 0; e < 2 && status == ICC_OK; ++e) {
        status = list_nodes(&items[e], pairing->graph[e], work, memory);
        if (status == ICC_OK)
            status = list_islands(&items[2 + e], pairing->graph[e], memory);
    }
    if (status == ICC_OK) {
        iccp_alike_sure(pairing->node, &items[0], &items[1]);
        iccp_alike_sure(pairing->border, &items[2], &items[3]);
        status = fit(pairing, items, memory);
    }
    if (status == ICC_OK)
        status = settle(pairing->node, pairing, &items[0], &items[1], &parts[0]);
    if (status == ICC_OK)
        status = settle(pairing->border, pairing, &items[2], &items[3], &parts[1]);
    for (int k = 0; k < 4; ++k)
        alikes_free(&items[k], memory);
    return status;
}

/* Pairs the borders between nodes. */
static icc_status pair_borders(iccp_layer_pairing *pairing, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    iccp_alikes items[2] = {{0}, {0}};
    icc_status status = list_borders(&items[0], pairing->graph[0], pairing->node, memory);
    if (status == ICC_OK)
        status = list_borders(&items[1], pairing->graph[1], NULL, memory);
    if (status == ICC_OK) {
        iccp_alike_sure(pairing->border, &items[0], &items[1]);
        status = settle(pairing->border, pairing, &items[0], &items[1], env);
    }
    alikes_free(&items[0], memory);
    alikes_free(&items[1], memory);
    return status;
}

icc_status iccp_layer_pairing_create(iccp_layer_pairing *pairing, const iccp_layer_graph *source,
                                     const iccp_layer_graph *target, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    const size_t most = source->layer->n_sides > target->layer->n_sides ? source->layer->n_sides
                                                                        : target->layer->n_sides;
    *pairing = (iccp_layer_pairing){.graph = {source, target}};
    pairing->node = iccp_alloc(memory, source->layer->n, sizeof *pairing->node);
    pairing->border = iccp_alloc(memory, source->n_borders, sizeof *pairing->border);
    pairing->back = iccp_alloc(memory, target->n_borders, sizeof *pairing->back);
    uint32_t *const work = iccp_alloc(memory, 2 * most, 2 * sizeof *work);
    icc_status status =
        pairing->node != NULL && pairing->border != NULL && pairing->back != NULL && work != NULL
            ? ICC_OK
            : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        memset(pairing->node, 0xff, source->layer->n * sizeof *pairing->node);
        memset(pairing->border, 0xff, source->n_borders * sizeof *pairing->border);
        memset(pairing->back, 0xff, target->n_borders * sizeof *pairing->back);
        iccp_env parts[2];
        iccp_split(parts, 2, (const double[]){1, 1}, env);
        status = pair_places(pairing, work, &parts[0]);
        if (status == ICC_OK)
            status = pair_borders(pairing, &parts[1]);
    }
    for (uint32_t b = 0; b < source->n_borders && status == ICC_OK; ++b)
        if (pairing->border[b] != NONE)
            pairing->back[pairing->border[b]] = b;
    iccp_free(memory, work);
    return status;
}
