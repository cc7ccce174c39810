/* Joins vertices of a layer. Some places stand for others (representatives): each place in the
 * order given, unless it lies within the weld length of an earlier one that stands for others. A
 * vertex moves to the nearest of them, so by no more than the weld length, and never along a
 * chain. */
#include "match/coverage/layer.h"

#include "base/sort.h"
#include "domain/domain.h"
#include "geometry/facet_tree.h"
#include "geometry/point_order.h"
#include "geometry/segment.h"
#include "math/vec.h"

#include <math.h>
#include <string.h>

#define NONE UINT32_MAX

typedef struct welding {
    iccp_layer *layer;
    uint32_t *same; /* of each vertex: the first one in exactly the same place */
    uint32_t *lead; /* of each of these: the one that it moves to */
    double *far2;   /* squared distance to it */
    uint32_t *list; /* places in the order of x and y, then pairs of the tree */
    size_t n_list;
    iccp_facet_tree tree;
    size_t n_visited; /* places since the last report: many if the weld length is long */
    const iccp_env *env;
} welding;

static icc_status reserve(welding *w, const iccp_memory *memory)
{
    const size_t n = w->layer->n;
    w->same = iccp_alloc(memory, n, sizeof *w->same);
    w->lead = iccp_alloc(memory, n, sizeof *w->lead);
    w->far2 = iccp_alloc(memory, n, sizeof *w->far2);
    w->list = iccp_alloc(memory, n, 2 * sizeof *w->list);
    return w->same != NULL && w->lead != NULL && w->far2 != NULL && w->list != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void release(welding *w, const iccp_memory *memory)
{
    iccp_facet_tree_free(&w->tree, memory);
    iccp_free(memory, w->same);
    iccp_free(memory, w->lead);
    iccp_free(memory, w->far2);
    iccp_free(memory, w->list);
}

/* Joins vertices in exactly the same place, and lists the different places as pairs for a tree. */
static void join_equal(welding *w)
{
    const double *const p = w->layer->place;
    const size_t n = w->layer->n;
    for (uint32_t v = 0; v < n; ++v)
        w->list[v] = v;
    iccp_order_points(w->list, w->list + n, n, p);
    for (size_t k = 0; k < n; ++k) {
        const uint32_t v = w->list[k], before = w->list[k > 0 ? k - 1 : 0];
        const bool is_same = k > 0 && iccp_point_equal(p + 2 * (size_t)v, p + 2 * (size_t)before);
        w->same[v] = is_same ? w->same[before] : v;
    }
    for (uint32_t v = 0; v < n; ++v)
        if (w->same[v] == v) {
            w->list[2 * w->n_list] = w->list[2 * w->n_list + 1] = v;
            ++w->n_list;
            w->lead[v] = NONE;
        }
}

static void query_around(iccp_facet_query *query, const welding *w, uint32_t v)
{
    const double *const p = w->layer->place + 2 * (size_t)v, r = w->layer->weld;
    iccp_facet_query_start(query, &w->tree,
                           (const double[]){p[0] - r, p[1] - r, p[0] + r, p[1] + r});
}

/* The next place within the weld length of v, and its squared distance. */
static bool next_near(welding *w, iccp_facet_query *query, uint32_t v, uint32_t *near, double *d2)
{
    uint32_t at;
    while (iccp_facet_query_next(query, &at)) {
        ++w->n_visited;
        *near = w->list[2 * (size_t)at];
        *d2 = iccp_vec_distance2(2, w->layer->place + 2 * (size_t)v,
                                 w->layer->place + 2 * (size_t)*near);
        if (*near != v && *d2 <= w->layer->weld * w->layer->weld)
            return true;
    }
    return false;
}

static icc_status report(welding *w, double share)
{
    if (w->n_visited < ICCP_VERTICES_PER_REPORT)
        return ICC_OK;
    w->n_visited = 0;
    return iccp_progress(w->env, NULL, share);
}

/* Chooses the places that stand for others, and the nearest of them for each other place. */
static icc_status choose(welding *w)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; k < w->n_list && status == ICC_OK; ++k) {
        const uint32_t v = w->list[2 * k];
        uint32_t near;
        double d2;
        if (w->lead[v] != NONE)
            continue;
        w->lead[v] = v;
        w->far2[v] = 0;
        iccp_facet_query query;
        query_around(&query, w, v);
        while (next_near(w, &query, v, &near, &d2))
            if (w->lead[near] == NONE || d2 < w->far2[near]) {
                w->lead[near] = v;
                w->far2[near] = d2;
            }
        status = report(w, 0.5 * (double)k / (double)w->n_list);
    }
    return status;
}

/* Counts the places that have a neighbour within the weld length which moved elsewhere. */
static icc_status count_chains(welding *w)
{
    iccp_layer *const layer = w->layer;
    icc_status status = ICC_OK;
    for (size_t k = 0; k < w->n_list && status == ICC_OK; ++k) {
        const uint32_t v = w->list[2 * k];
        uint32_t near;
        double d2;
        bool is_chain = false;
        iccp_facet_query query;
        query_around(&query, w, v);
        while (!is_chain && next_near(w, &query, v, &near, &d2))
            is_chain = w->lead[near] != w->lead[v];
        if (is_chain && layer->n_chains++ == 0)
            memcpy(layer->chain, layer->place + 2 * (size_t)v, sizeof layer->chain);
        status = report(w, 0.5 + 0.5 * (double)k / (double)w->n_list);
    }
    return status;
}

/* Drops the places that nothing moved to, and edges that became points. */
static void compress(welding *w)
{
    iccp_layer *const layer = w->layer;
    uint32_t *const number = w->list;
    size_t n = 0, n_edges = 0;
    double most2 = 0;
    for (size_t v = 0; v < layer->n; ++v) {
        const uint32_t lead = w->lead[w->same[v]];
        layer->n_welded += lead != w->same[v];
        most2 = w->far2[w->same[v]] > most2 ? w->far2[w->same[v]] : most2;
    }
    for (uint32_t v = 0; v < layer->n; ++v)
        if (w->same[v] == v && w->lead[v] == v) {
            memmove(layer->place + 2 * n, layer->place + 2 * (size_t)v, 2 * sizeof(double));
            number[v] = (uint32_t)n++;
        }
    for (size_t k = 0; k < layer->n_edges; ++k) {
        iccp_layer_edge e = layer->edge[k];
        e.from = number[w->lead[w->same[e.from]]];
        e.to = number[w->lead[w->same[e.to]]];
        if (e.from != e.to)
            layer->edge[n_edges++] = e;
    }
    layer->n = n;
    layer->n_edges = n_edges;
    layer->most_moved = sqrt(most2);
}

icc_status iccp_layer_weld(iccp_layer *layer, const iccp_env *env)
{
    welding w = {.layer = layer, .env = env};
    icc_status status = reserve(&w, &env->memory);
    if (status == ICC_OK) {
        join_equal(&w);
        iccp_facet_tree_create(&w.tree, 2, layer->place, w.n_list, w.list, &env->memory);
        status = w.tree.boxes != NULL ? iccp_progress(env, NULL, 0) : ICC_ERR_MEMORY;
    }
    if (status == ICC_OK)
        status = choose(&w);
    if (status == ICC_OK)
        status = count_chains(&w);
    if (status == ICC_OK)
        compress(&w);
    release(&w, &env->memory);
    return status;
}
