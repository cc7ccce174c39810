/* Weights made from others at the same nodes: the edits of the thesis' window (section 6.3.1), and
 * rigid parts (5.4). */
#include "kernel/weights/handle_weights.h"

#include "base/error.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

static void give_up(icc_weights **out)
{
    iccp_weights_release(*out);
    *out = NULL;
}

/* Optimises some nodes of a copy whose weights have been set. */
static icc_status optimise_changed(icc_weights *copy, const icc_weights *before, size_t n,
                                   const uint32_t *nodes, const iccp_env *env)
{
    const icc_status status = iccp_weights_optimise(copy, n, nodes, env);
    return status == ICC_OK ? iccp_weights_interpolate(copy, before, env) : status;
}

/* 1 at the centre, 0 at the radius, with no slope at either. */
static double brush(const iccp_node_set *set, size_t node, const double *centre, double radius)
{
    double d = 0;
    for (size_t k = 0; k < set->dim; ++k)
        d = iccp_hypot(d, set->given[set->dim * node + k] - centre[k]);
    d /= radius;
    return d < 1 ? (1 - d * d) * (1 - d * d) : 0;
}

icc_status iccp_weights_paint(icc_weights **out, const icc_weights *weights, size_t handle,
                              const double *centre, double radius, double amount,
                              const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    uint32_t *nodes = iccp_alloc(&env->memory, set->n, sizeof *nodes);
    size_t n = 0;
    *out = NULL;
    icc_status status = nodes != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_weights_copy(out, weights, env);
    for (uint32_t i = 0; status == ICC_OK && i < set->n; ++i) {
        const double share = set->held[i] ? 0 : brush(set, i, centre, radius);
        if (!(share > 0))
            continue;
        (*out)->values[set->n_handles * i + handle] += amount * share;
        nodes[n++] = i;
    }
    if (status == ICC_OK)
        status = optimise_changed(*out, weights, n, nodes, env);
    if (status != ICC_OK)
        give_up(out);
    iccp_free(&env->memory, nodes);
    return status;
}

/* If a node were listed twice, two threads would work on it. */
static icc_status check_nodes(const iccp_node_set *set, size_t n, const uint32_t *nodes,
                              const iccp_env *env, icc_error *err)
{
    bool *seen = iccp_alloc_zero(&env->memory, set->n, sizeof *seen);
    icc_status status = seen != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; status == ICC_OK && k < n; ++k) {
        if (nodes[k] >= set->n)
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_NODE, (int64_t)k,
                                  "node %lu does not exist", (unsigned long)nodes[k]);
        else if (seen[nodes[k]])
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_NODE, (int64_t)k,
                                  "node %lu is named twice", (unsigned long)nodes[k]);
        else
            seen[nodes[k]] = true;
    }
    iccp_free(&env->memory, seen);
    return status;
}

icc_status iccp_weights_repaint(icc_weights **out, const icc_weights *weights, size_t n,
                                const uint32_t *nodes, const double *values, const iccp_env *env,
                                icc_error *err)
{
    const iccp_node_set *set = weights->nodes;
    const size_t m = set->n_handles;
    *out = NULL;
    icc_status status = check_nodes(set, n, nodes, env, err);
    if (status == ICC_OK)
        status = iccp_weights_copy(out, weights, env);
    for (size_t k = 0; status == ICC_OK && k < n; ++k)
        if (!set->held[nodes[k]])
            memcpy((*out)->values + m * nodes[k], values + m * k, m * sizeof *values);
    if (status == ICC_OK)
        status = optimise_changed(*out, weights, n, nodes, env);
    if (status != ICC_OK)
        give_up(out);
    return status;
}

icc_status iccp_weights_with_method(icc_weights **out, const icc_weights *weights, int32_t method,
                                    const iccp_env *env, icc_error *err)
{
    icc_status status = iccp_weights_copy(out, weights, env);
    if (status != ICC_OK)
        return status;
    (*out)->info.method = method;
    status = iccp_weights_start(*out, env, err);
    if (status == ICC_OK)
        status = iccp_weights_interpolate(*out, NULL, env);
    if (status != ICC_OK)
        give_up(out);
    return status;
}

static icc_status stiffen(icc_weights *copy, size_t n, const uint32_t *nodes,
                          const double *rigidity, double energy[2], const iccp_env *env)
{
    const iccp_node_set *set = copy->nodes;
    const iccp_nodes all = iccp_node_set_view(set);
    bool *held = iccp_alloc(&env->memory, set->n, sizeof *held);
    if (held == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < set->n; ++i)
        held[i] = set->held[i] || set->edge[i] != ICCP_NO_EDGE;
    const icc_status status = iccp_stiffen(&all, set->handles, set->collocation, n, nodes, rigidity,
                                           held, copy->info.method == ICC_WEIGHTS_QP, copy->values,
                                           copy->coefficients, energy, &copy->info.residual, env);
    iccp_free(&env->memory, held);
    return status;
}

icc_status iccp_weights_stiffen(icc_weights **out, const icc_weights *weights, size_t n,
                                const uint32_t *nodes, const double *rigidity, double energy[2],
                                const iccp_env *env, icc_error *err)
{
    double local[2];
    *out = NULL;
    if (weights->info.method == ICC_WEIGHTS_BIHARMONIC)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "biharmonic weights cannot be stiffened, because they do not reproduce "
                         "points");
    icc_status status = check_nodes(weights->nodes, n, nodes, env, err);
    if (status == ICC_OK)
        status = iccp_weights_copy(out, weights, env);
    if (status == ICC_OK)
        status = stiffen(*out, n, nodes, rigidity, local, env);
    if (status != ICC_OK) {
        give_up(out);
        return status;
    }
    const double scale = iccp_node_set_scale(weights->nodes);
    for (int k = 0; energy != NULL && k < 2; ++k)
        energy[k] = local[k] * scale * scale;
    return ICC_OK;
}
