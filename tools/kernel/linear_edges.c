/* Sets the weights at nodes on edges. */
#include "kernel/linear_edges.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>

/* A node this close to an edge, as a share of the edge's length, is on it. */
static const double ON_EDGE = 1e-9;

/* True if a node is on an edge between its ends. *share is its place from the first end. */
static bool is_on_edge(const handle_set *set, size_t edge, const double *node, double *share)
{
    const double *from = set->handles + set->dim * set->edges[2 * edge];
    const double *to = set->handles + set->dim * set->edges[2 * edge + 1];
    double along = 0, length = 0, away = 0;
    for (size_t c = 0; c < set->dim; c++) {
        along += (node[c] - from[c]) * (to[c] - from[c]);
        length += (to[c] - from[c]) * (to[c] - from[c]);
    }
    *share = length > 0 ? along / length : -1;
    for (size_t c = 0; c < set->dim; c++)
        away += pow(node[c] - from[c] - *share * (to[c] - from[c]), 2);
    return *share > ON_EDGE && *share < 1 - ON_EDGE && away <= ON_EDGE * ON_EDGE * length;
}

icc_status linear_edges_make(icc_weights **out, const icc_weights *weights, const handle_set *set,
                             const icc_env *env, icc_error *err)
{
    icc_weights_info info = {.size = sizeof info};
    icc_weights_get_info(weights, &info);
    size_t n = 0, m = set->n_handles;
    double *places = need(info.n_nodes, set->dim * sizeof *places);
    uint32_t *nodes = need(info.n_nodes, sizeof *nodes);
    double *values = need(info.n_nodes, m * sizeof *values);
    icc_weights_get_nodes(weights, places, NULL, NULL, NULL);
    for (size_t i = 0; i < info.n_nodes; i++) {
        double share;
        size_t e = 0;
        while (e < set->n_edges && !is_on_edge(set, e, places + set->dim * i, &share))
            e++;
        if (e == set->n_edges)
            continue;
        for (size_t k = 0; k < m; k++)
            values[m * n + k] = 0;
        values[m * n + set->edges[2 * e]] = 1 - share;
        values[m * n + set->edges[2 * e + 1]] = share;
        nodes[n++] = (uint32_t)i;
    }
    *out = NULL;
    icc_status status =
        n == 0 ? ICC_OK : icc_weights_repaint(out, weights, n, nodes, values, env, err);
    free(places);
    free(nodes);
    free(values);
    return status;
}
