/* From nodes to weights everywhere: Sakaridis, Kernel Coordinates (ETH Zurich 2016), chapters 4 and
 * 6. */
#include "kernel/handle_weights.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/threads.h"

#include <math.h>
#include <string.h>

/* Nodes in a task. */
enum { GRAIN = 256 };

/* ---- initial weights ---- */

/* The sample that is nearest to a node on a line. */
static size_t nearest_sample(const icc_sampling *s, const double *place)
{
    const size_t dim = s->shape->dim;
    size_t nearest = 0;
    double least = HUGE_VAL;
    for (size_t i = 0; i < s->info.n_samples; ++i) {
        double d = 0;
        for (size_t k = 0; k < dim; ++k)
            d = hypot(d, s->points[dim * i + k] - place[k]);
        nearest = d < least ? i : nearest;
        least = fmin(least, d);
    }
    return nearest;
}

static void take_given(const iccp_layout *l, const double *given)
{
    for (size_t i = l->n_handles; i < l->n; ++i) {
        const size_t sample = l->sample[i] != UINT32_MAX
                                  ? l->sample[i]
                                  : nearest_sample(l->sampling, l->given + l->dim * i);
        memcpy(l->initial + l->n_handles * i, given + l->n_handles * sample,
               l->n_handles * sizeof *given);
    }
}

/* Exactly (4.11) at the handles, and (4.7) on edges. */
static void set_handles(const iccp_layout *l, bool edges)
{
    const size_t m = l->n_handles;
    memset(l->initial, 0, m * m * sizeof *l->initial);
    for (size_t j = 0; j < m; ++j)
        l->initial[m * j + j] = 1;
    for (size_t i = m; edges && i < l->n; ++i) {
        if (l->edge[i] == ICCP_NO_EDGE)
            continue;
        const uint32_t *ends = l->edges + 2 * l->edge[i];
        memset(l->initial + m * i, 0, m * sizeof *l->initial);
        l->initial[m * i + ends[0]] = 1 - l->share[i];
        l->initial[m * i + ends[1]] = l->share[i];
    }
}

static icc_status initialise(iccp_layout *l, const icc_weights_options *options,
                             const iccp_env *env)
{
    const bool edges = options->initial == ICC_INITIAL_EDGES;
    const iccp_nodes nodes = iccp_layout_nodes(l);
    l->initial = iccp_alloc_zero(&l->memory, l->n, l->n_handles * sizeof *l->initial);
    if (l->initial == NULL)
        return ICC_ERR_MEMORY;
    if (options->initial == ICC_INITIAL_GIVEN)
        take_given(l, options->initial_weights);
    if (options->initial == ICC_INITIAL_INVERSE)
        iccp_initial_inverse(&nodes, l->initial);
    set_handles(l, edges);
    if (options->initial != ICC_INITIAL_HEAT && !edges)
        return ICC_OK;
    return iccp_diffuse(&nodes, iccp_collocation_matrix(l->collocation), options->steps, edges,
                        options->within_shape >= 0, l->initial, env);
}

/* ---- weights ---- */

typedef struct optimisation {
    icc_weights *weights;
    const uint32_t *nodes;
    const iccp_memory *memory;
} optimisation;

static icc_status optimise_some(void *argument, size_t begin, size_t end)
{
    const optimisation *o = argument;
    icc_weights *weights = o->weights;
    const iccp_layout *l = weights->layout;
    double *work = iccp_alloc(o->memory, iccp_optimise_work(l->handles), sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = begin; k < end; ++k) {
        const size_t i = o->nodes != NULL ? o->nodes[k] : k;
        if (!l->held[i])
            weights->status[i] =
                iccp_optimise(l->handles, weights->info.method, l->points + l->dim * i,
                              weights->values + l->n_handles * i, work);
    }
    iccp_free(o->memory, work);
    return ICC_OK;
}

icc_status iccp_weights_optimise(icc_weights *weights, size_t n, const uint32_t *nodes,
                                 const iccp_env *env)
{
    optimisation o = {weights, nodes, &env->memory};
    const icc_status status = iccp_for_chunks(env, "weights", n, GRAIN, optimise_some, &o);
    weights->info.n_infeasible = 0;
    for (size_t i = 0; i < weights->layout->n; ++i)
        weights->info.n_infeasible += weights->status[i] != ICC_OK;
    return status;
}

/* Ends of lines that are nobody else's are optimised like any node, the nodes between them
 * never. */
static icc_status optimise_ends(icc_weights *weights, const iccp_env *env)
{
    const iccp_layout *l = weights->layout;
    const iccp_nodes nodes = iccp_layout_nodes(l);
    double *work = iccp_alloc(&env->memory, iccp_optimise_work(l->handles), sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < l->n_lines; ++k) {
        const size_t ends[2] = {l->lines[k].from, l->lines[k].to};
        const size_t first = k == 0 ? l->n_handles : l->lines[k - 1].first + l->lines[k - 1].count;
        for (size_t e = 0; e < 2; ++e)
            if (ends[e] >= first)
                weights->status[ends[e]] =
                    iccp_optimise(l->handles, weights->info.method, l->points + l->dim * ends[e],
                                  weights->values + l->n_handles * ends[e], work);
        iccp_straighten(&nodes, &l->lines[k], iccp_layout_parallel(l, k), weights->values);
    }
    iccp_free(&env->memory, work);
    return ICC_OK;
}

icc_status iccp_weights_start(icc_weights *weights, const iccp_env *env)
{
    const iccp_layout *l = weights->layout;
    const double start = iccp_seconds();
    memcpy(weights->values, l->initial, l->n * l->n_handles * sizeof *l->initial);
    for (size_t i = 0; i < l->n; ++i)
        weights->status[i] = ICC_OK;
    icc_status status = optimise_ends(weights, env);
    if (status == ICC_OK)
        status = iccp_weights_optimise(weights, l->n, NULL, env);
    for (size_t k = 0; status == ICC_OK && k < l->n_lines; ++k)
        status = iccp_weights_follow(weights, k, env);
    weights->info.seconds_weights = iccp_seconds() - start;
    return status;
}

/* Columns that are the same bit for bit have the same coefficients. */
icc_status iccp_weights_interpolate(icc_weights *weights, const icc_weights *before,
                                    const iccp_env *env)
{
    const iccp_layout *l = weights->layout;
    const size_t m = l->n_handles;
    bool *changed = iccp_alloc_zero(&env->memory, m, sizeof *changed);
    if (changed == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < l->n; ++i)
        for (size_t j = 0; j < m; ++j)
            changed[j] |= before == NULL || weights->values[m * i + j] != before->values[m * i + j];
    const icc_status status = iccp_collocation_solve_some(l->collocation, m, weights->values,
                                                          changed, weights->coefficients, env);
    iccp_free(&env->memory, changed);
    return status;
}

/* ---- the object ---- */

/* Everything but what is in the arrays. */
static icc_status allocate(icc_weights **out, const iccp_layout *layout, const iccp_env *env)
{
    const size_t n = layout->n, m = layout->n_handles;
    icc_weights *weights = iccp_alloc_zero(&env->memory, 1, sizeof *weights);
    *out = weights;
    if (weights == NULL)
        return ICC_ERR_MEMORY;
    weights->memory = env->memory;
    atomic_init(&weights->references, 1);
    weights->layout = iccp_layout_retain(layout);
    weights->values = iccp_alloc(&weights->memory, n, m * sizeof *weights->values);
    weights->status = iccp_alloc(&weights->memory, n, sizeof *weights->status);
    weights->coefficients =
        iccp_alloc(&weights->memory, n + layout->dim + 1, m * sizeof *weights->coefficients);
    return weights->values != NULL && weights->status != NULL && weights->coefficients != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void describe(icc_weights *weights, const icc_weights_options *options)
{
    const iccp_layout *l = weights->layout;
    weights->info.dim = (int32_t)l->dim;
    weights->info.kernel = options->kernel;
    weights->info.initial = options->initial;
    weights->info.method = options->method;
    weights->info.sigma = options->sigma;
    weights->info.n_handles = l->n_handles;
    weights->info.n_nodes = l->n;
    weights->info.n_entries = iccp_collocation_entries(l->collocation);
    weights->info.definiteness = iccp_collocation_definiteness(l->collocation);
}

static icc_status finish(icc_weights **out, iccp_layout *layout, const icc_weights_options *options,
                         const iccp_env *env)
{
    const double start = iccp_seconds();
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 4, 2}, env);
    icc_status status = initialise(layout, options, &part[0]);
    const double seconds = iccp_seconds() - start;
    if (status == ICC_OK)
        status = allocate(out, layout, env);
    if (status != ICC_OK)
        return status;
    describe(*out, options);
    (*out)->info.seconds_initial = seconds;
    status = iccp_weights_start(*out, &part[1]);
    return status == ICC_OK ? iccp_weights_interpolate(*out, NULL, &part[2]) : status;
}

icc_status iccp_weights_create(icc_weights **out, const icc_sampling *sampling, size_t n_handles,
                               const double *handles, const icc_weights_options *options,
                               const iccp_env *env, icc_error *err)
{
    iccp_layout *layout;
    const double start = iccp_seconds();
    *out = NULL;
    const iccp_env weights = iccp_part(env, "weights", 0, 1);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, &weights);
    icc_status status =
        iccp_layout_create(&layout, sampling, n_handles, handles, options, &part[0], err);
    const double seconds = iccp_seconds() - start;
    if (status == ICC_OK)
        status = finish(out, layout, options, &part[1]);
    iccp_layout_release(layout);
    if (status == ICC_OK)
        (*out)->info.seconds_factor = seconds;
    if (status == ICC_OK)
        return ICC_OK;
    iccp_weights_release(*out);
    *out = NULL;
    return status;
}

icc_status iccp_weights_copy(icc_weights **out, const icc_weights *from, const iccp_env *env)
{
    const iccp_layout *l = from->layout;
    const icc_status status = allocate(out, l, env);
    if (status != ICC_OK) {
        iccp_weights_release(*out);
        *out = NULL;
        return status;
    }
    icc_weights *weights = *out;
    weights->info = from->info;
    memcpy(weights->values, from->values, l->n * l->n_handles * sizeof *from->values);
    memcpy(weights->status, from->status, l->n * sizeof *from->status);
    memcpy(weights->coefficients, from->coefficients,
           (l->n + l->dim + 1) * l->n_handles * sizeof *from->coefficients);
    return ICC_OK;
}

icc_weights *iccp_weights_retain(const icc_weights *weights)
{
    icc_weights *k = (icc_weights *)weights;
    atomic_fetch_add(&k->references, 1);
    return k;
}

void iccp_weights_release(icc_weights *weights)
{
    if (weights == NULL || atomic_fetch_sub(&weights->references, 1) > 1)
        return;
    iccp_layout_release(weights->layout);
    iccp_free(&weights->memory, weights->values);
    iccp_free(&weights->memory, weights->status);
    iccp_free(&weights->memory, weights->coefficients);
    const iccp_memory memory = weights->memory;
    iccp_free(&memory, weights);
}
