/* Tests whether directed edges are the boundary of a plane region on their left. The edges are a
 * plane graph. A sweep over it (geometry/graph_sweep.h) counts how often they wind around the
 * places beside each edge. */
#include "geometry/edges_bound.h"

#include "geometry/graph_sweep.h"
#include "geometry/point_order.h"
#include "geometry/segment.h"

typedef struct work {
    uint32_t *nodes, *order;    /* n_points each */
    uint32_t *first;            /* n_points + 1 */
    uint32_t *leaving, *around; /* 2 n each */
    int32_t *gain, *left;       /* n each */
    uint32_t *below;            /* n_points */
} work;

/* Lists the half-sides that leave each point. Half-side h leaves ends[h]. */
static void list_leaving(const work *w, const iccp_edges *edges)
{
    uint32_t n = 0;
    for (size_t h = 0; h < 2 * edges->n; ++h)
        ++w->first[edges->ends[h]];
    for (size_t v = 0; v < edges->n_points; ++v)
        w->first[v] = n += w->first[v];
    w->first[edges->n_points] = n;
    for (uint32_t h = 2 * (uint32_t)edges->n; h-- > 0;)
        w->leaving[--w->first[edges->ends[h]]] = h;
}

/* Lists the points with edges by x, then y. Returns their number, or 0 if two are equal. */
static size_t list_nodes(const work *w, const iccp_edges *edges, const double *points)
{
    size_t n = 0;
    for (uint32_t v = 0; v < edges->n_points; ++v)
        if (w->first[v] < w->first[v + 1])
            w->nodes[n++] = v;
    iccp_order_points(w->nodes, w->order, n, points);
    for (size_t i = 1; i < n; ++i)
        if (iccp_point_equal(points + 2 * (size_t)w->nodes[i - 1],
                             points + 2 * (size_t)w->nodes[i]))
            return 0;
    return n;
}

static icc_status run(bool *bound, const work *w, const iccp_edges *edges, const double *points,
                      const iccp_env *env)
{
    iccp_graph_defect found = {.kind = 0};
    list_leaving(w, edges);
    const size_t n_nodes = list_nodes(w, edges, points);
    const iccp_graph graph = {points,   edges->ends, edges->n,   n_nodes,
                              w->nodes, w->first,    w->leaving, w->gain};
    for (size_t e = 0; e < edges->n; ++e)
        w->gain[e] = 1;
    for (size_t i = 0; i < n_nodes; ++i)
        if (!iccp_graph_order_node(&found, &graph, w->nodes[i], w->leaving + w->first[w->nodes[i]],
                                   w->around))
            return ICC_OK;
    const icc_status status = iccp_graph_sweep(&found, &graph, w->left, w->below, env);
    *bound = status == ICC_OK && n_nodes > 0 && found.kind == 0;
    for (size_t e = 0; e < edges->n && *bound; ++e)
        *bound = w->left[e] == 1;
    return status;
}

icc_status iccp_edges_bound(bool *bound, const iccp_edges *edges, const double *points,
                            const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n_points = edges->n_points, n = edges->n;
    const work w = {.nodes = iccp_alloc(memory, n_points, sizeof *w.nodes),
                    .order = iccp_alloc(memory, n_points, sizeof *w.order),
                    .first = iccp_alloc_zero(memory, n_points + 1, sizeof *w.first),
                    .leaving = iccp_alloc(memory, n, 2 * sizeof *w.leaving),
                    .around = iccp_alloc(memory, n, 2 * sizeof *w.around),
                    .gain = iccp_alloc(memory, n, sizeof *w.gain),
                    .left = iccp_alloc(memory, n, sizeof *w.left),
                    .below = iccp_alloc(memory, n_points, sizeof *w.below)};
    const bool is_there = w.nodes != NULL && w.order != NULL && w.first != NULL &&
                          w.leaving != NULL && w.around != NULL && w.gain != NULL &&
                          w.left != NULL && w.below != NULL;
    *bound = false;
    const icc_status status = is_there ? run(bound, &w, edges, points, env) : ICC_ERR_MEMORY;
    iccp_free(memory, w.nodes);
    iccp_free(memory, w.order);
    iccp_free(memory, w.first);
    iccp_free(memory, w.leaving);
    iccp_free(memory, w.around);
    iccp_free(memory, w.gain);
    iccp_free(memory, w.left);
    iccp_free(memory, w.below);
    return status;
}
