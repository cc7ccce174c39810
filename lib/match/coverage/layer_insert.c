/* Puts places into the edges that pass close by. An edge with new places is searched again, because
 * its parts lie elsewhere. No place comes into one edge twice, so this ends. */
#include "match/coverage/layer.h"

#include "base/minmax.h"
#include "base/sort.h"
#include "domain/domain.h"
#include "geometry/facet_tree.h"
#include "geometry/segment.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

/* A place beside an edge, and its position as a share of it. */
typedef struct visitor {
    double at;
    uint32_t place;
} visitor;

typedef struct insertion {
    const iccp_layer *layer;
    uint32_t *pair; /* the places as facets of the tree: each twice */
    iccp_facet_tree tree;
    uint32_t *seen; /* of each place: the last edge that has it, from 1 on */
    visitor *visitor;
    size_t n_visitors, room;
    uint32_t *way; /* the places along the edge; parts behind `done` are still to be searched */
    size_t way_room;
    iccp_layer_edge *out;
    size_t n_out, out_room;
} insertion;

static bool grow(const iccp_memory *memory, void *array, size_t n, size_t *room, size_t size)
{
    if (n < *room)
        return true;
    const size_t more = 2 * *room + 64;
    if (!iccp_enlarge(memory, array, n, more, size))
        return false;
    *room = more;
    return true;
}

static int by_share(const void *a, const void *b)
{
    const visitor *const p = a, *const q = b;
    if (p->at != q->at)
        return p->at < q->at ? -1 : 1;
    return p->place < q->place ? -1 : p->place > q->place;
}

/* Returns true if p lies beside the segment from a to b, at most `reach` away from its inside. */
static bool is_beside(const double *a, const double *b, const double *p, double reach, double *at)
{
    const double d2 = iccp_segment_nearest(a, b, p, at);
    return (*at > 0 && *at < 1 && d2 <= reach * reach) || iccp_segment_has(a, b, p);
}

/* Lists the places beside the segment from a to b that edge `stamp` does not have yet. */
static icc_status find_visitors(insertion *w, uint32_t a, uint32_t b, uint32_t stamp,
                                const iccp_memory *memory)
{
    const double *const place = w->layer->place, *const p = place + 2 * (size_t)a,
                        *const q = place + 2 * (size_t)b, reach = w->layer->weld;
    iccp_facet_query query;
    iccp_facet_query_start(
        &query, &w->tree,
        (const double[]){iccp_min(p[0], q[0]) - reach, iccp_min(p[1], q[1]) - reach,
                         iccp_max(p[0], q[0]) + reach, iccp_max(p[1], q[1]) + reach});
    query.from = p;
    query.to = q;
    query.reach = reach;
    w->n_visitors = 0;
    uint32_t v;
    double at;
    while (iccp_facet_query_next(&query, &v)) {
        if (w->seen[v] == stamp || !is_beside(p, q, place + 2 * (size_t)v, reach, &at))
            continue;
        if (!grow(memory, &w->visitor, w->n_visitors, &w->room, sizeof *w->visitor))
            return ICC_ERR_MEMORY;
        w->visitor[w->n_visitors++] = (visitor){at, v};
        w->seen[v] = stamp;
    }
    iccp_sort(w->visitor, w->n_visitors, sizeof *w->visitor, by_share);
    return ICC_OK;
}

static icc_status put_out(insertion *w, iccp_layer_edge edge, const iccp_memory *memory)
{
    if (!grow(memory, &w->out, w->n_out, &w->out_room, sizeof *w->out))
        return ICC_ERR_MEMORY;
    w->out[w->n_out++] = edge;
    return ICC_OK;
}

/* Divides one edge. `way` is a stack of places: the first part still to be searched lies on top,
 * from `from` to the top. */
static icc_status divide(insertion *w, const iccp_layer_edge *edge, uint32_t stamp,
                         const iccp_memory *memory)
{
    const bool is_back = edge->to < edge->from;
    uint32_t from = is_back ? edge->to : edge->from;
    size_t n = 0;
    if (!grow(memory, &w->way, 0, &w->way_room, sizeof *w->way))
        return ICC_ERR_MEMORY;
    w->way[n++] = is_back ? edge->from : edge->to;
    w->seen[edge->from] = w->seen[edge->to] = stamp;
    while (n > 0) {
        const uint32_t to = w->way[n - 1];
        icc_status status = find_visitors(w, from, to, stamp, memory);
        for (size_t k = w->n_visitors; k-- > 0 && status == ICC_OK;) {
            if (!grow(memory, &w->way, n, &w->way_room, sizeof *w->way))
                status = ICC_ERR_MEMORY;
            else
                w->way[n++] = w->visitor[k].place;
        }
        if (status == ICC_OK && w->n_visitors == 0) {
            const uint32_t a = is_back ? to : from, b = is_back ? from : to;
            status = put_out(w, (iccp_layer_edge){a, b, edge->region}, memory);
            from = to;
            --n;
        }
        if (status != ICC_OK)
            return status;
    }
    return ICC_OK;
}

static icc_status prepare(insertion *w, const iccp_memory *memory)
{
    const size_t n = w->layer->n;
    w->pair = iccp_alloc(memory, n, 2 * sizeof *w->pair);
    w->seen = iccp_alloc_zero(memory, n, sizeof *w->seen);
    if (w->pair == NULL || w->seen == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < n; ++v)
        w->pair[2 * (size_t)v] = w->pair[2 * (size_t)v + 1] = v;
    iccp_facet_tree_create(&w->tree, 2, w->layer->place, n, w->pair, memory);
    return w->tree.boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_layer_insert(iccp_layer *layer, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    insertion w = {.layer = layer};
    icc_status status = prepare(&w, memory);
    for (size_t k = 0; k < layer->n_edges && status == ICC_OK; ++k) {
        status = divide(&w, &layer->edge[k], (uint32_t)k + 1, memory);
        if (status == ICC_OK && k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, NULL, (double)k / (double)layer->n_edges);
    }
    if (status == ICC_OK) {
        layer->n_inserted = w.n_out - layer->n_edges;
        layer->n_edges = w.n_out;
        iccp_layer_edge *const old = layer->edge;
        layer->edge = w.out;
        w.out = old;
    }
    iccp_facet_tree_free(&w.tree, memory);
    iccp_free(memory, w.pair);
    iccp_free(memory, w.seen);
    iccp_free(memory, w.visitor);
    iccp_free(memory, w.way);
    iccp_free(memory, w.out);
    return status;
}

/* Finds the least distance of a place from a side that does not end there. */
icc_status iccp_layer_measure(iccp_layer *layer, const iccp_env *env)
{
    const iccp_memory *const memory = &env->memory;
    uint32_t *const ends = iccp_alloc(memory, layer->n_sides, 2 * sizeof *ends);
    iccp_facet_tree tree = {0};
    double best2 = HUGE_VAL;
    icc_status status = ends != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        for (size_t k = 0; k < layer->n_sides; ++k)
            memcpy(ends + 2 * k, layer->side[k].end, 2 * sizeof *ends);
        iccp_facet_tree_create(&tree, 2, layer->place, layer->n_sides, ends, memory);
        status = tree.boxes != NULL ? ICC_OK : ICC_ERR_MEMORY;
    }
    for (size_t m = 0; m < 2 * layer->n_sides && status == ICC_OK; ++m) {
        const uint32_t v = ends[m];
        const double *const p = layer->place + 2 * (size_t)v, r = sqrt(best2);
        iccp_facet_query query;
        iccp_facet_query_start(&query, &tree,
                               (const double[]){p[0] - r, p[1] - r, p[0] + r, p[1] + r});
        uint32_t k;
        double at;
        while (iccp_facet_query_next(&query, &k)) {
            const uint32_t *const end = layer->side[k].end;
            if (end[0] == v || end[1] == v)
                continue;
            const double d2 = iccp_segment_nearest(layer->place + 2 * (size_t)end[0],
                                                   layer->place + 2 * (size_t)end[1], p, &at);
            if (d2 < best2) {
                best2 = d2;
                memcpy(layer->least_apart_at, p, sizeof layer->least_apart_at);
            }
        }
        if (m % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, NULL, (double)m / (2 * (double)layer->n_sides));
    }
    layer->least_apart = sqrt(best2);
    iccp_facet_tree_free(&tree, memory);
    iccp_free(memory, ends);
    return status;
}
