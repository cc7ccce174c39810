/* Computes weights at nodes, and their interpolant: Sakaridis, Kernel Coordinates (ETH Zurich
 * 2016), chapters 4 and 6. */
#include "kernel/weights/handle_weights.h"

#include "base/clock.h"
#include "base/error.h"
#include "base/minmax.h"
#include "base/threads.h"
#include "kernel/biharmonic/biharmonic.h"
#include "math/elementary.h"

#include <math.h>
#include <string.h>

/* ---- initial weights ---- */

/* Returns the sample nearest to a node on a line. */
static size_t nearest_sample(const icc_sampling *s, const double *place)
{
    const size_t dim = s->shape->dim;
    size_t nearest = 0;
    double least = HUGE_VAL;
    for (size_t i = 0; i < s->info.n_samples; ++i) {
        double d = 0;
        for (size_t k = 0; k < dim; ++k)
            d = iccp_hypot(d, s->points[dim * i + k] - place[k]);
        nearest = d < least ? i : nearest;
        least = iccp_min(least, d);
    }
    return nearest;
}

/* Copies the caller's weights, which are given by sample. A node that is a sample takes its row,
 * and a node on a line that of the nearest sample. set_handles() sets the handles. */
static void take_given(const iccp_node_set *set, const double *given)
{
    for (size_t i = set->n_handles; i < set->n; ++i) {
        const size_t sample = set->sample[i] != UINT32_MAX
                                  ? set->sample[i]
                                  : nearest_sample(set->sampling, set->given + set->dim * i);
        memcpy(set->initial + set->n_handles * i, given + set->n_handles * sample,
               set->n_handles * sizeof *given);
    }
}

/* Sets exactly (4.11) at the handles, and (4.7) on edges. */
static void set_handles(const iccp_node_set *set, bool edges)
{
    const size_t m = set->n_handles;
    memset(set->initial, 0, m * m * sizeof *set->initial);
    for (size_t j = 0; j < m; ++j)
        set->initial[m * j + j] = 1;
    for (size_t i = m; edges && i < set->n; ++i) {
        if (set->edge[i] == ICCP_NO_EDGE)
            continue;
        const uint32_t *ends = set->edges + 2 * set->edge[i];
        memset(set->initial + m * i, 0, m * sizeof *set->initial);
        set->initial[m * i + ends[0]] = 1 - set->share[i];
        set->initial[m * i + ends[1]] = set->share[i];
    }
}

/* Sets the initial weights of all nodes by the chosen method. Diffusion starts from the weights
 * that set_handles() fixes. */
static icc_status initialise(iccp_node_set *set, const icc_weights_options *options,
                             const iccp_env *env)
{
    const bool edges = options->initial == ICC_INITIAL_EDGES;
    const iccp_nodes nodes = iccp_node_set_view(set);
    set->initial = iccp_alloc_zero(&set->memory, set->n, set->n_handles * sizeof *set->initial);
    if (set->initial == NULL)
        return ICC_ERR_MEMORY;
    if (options->initial == ICC_INITIAL_GIVEN)
        take_given(set, options->initial_weights);
    if (options->initial == ICC_INITIAL_INVERSE)
        iccp_initial_inverse(&nodes, set->initial);
    set_handles(set, edges);
    if (options->initial != ICC_INITIAL_HEAT && !edges)
        return ICC_OK;
    return iccp_diffuse(&nodes, iccp_collocation_matrix(set->collocation), options->steps, edges,
                        options->within_shape >= 0, set->initial, env);
}

/* ---- weights ---- */

typedef struct optimisation {
    icc_weights *weights;
    const uint32_t *nodes;
    const iccp_memory *memory;
} optimisation;

/* Computes the weights of nodes [begin, end) of the list, or of all nodes if it is NULL. Each node
 * is optimised by itself, so tasks share only the handles, which are read-only. */
static icc_status optimise_some(void *argument, size_t begin, size_t end)
{
    const optimisation *o = argument;
    icc_weights *weights = o->weights;
    const iccp_node_set *set = weights->nodes;
    double *work = iccp_alloc(o->memory, iccp_optimise_work(set->handles), sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = begin; k < end; ++k) {
        const size_t i = o->nodes != NULL ? o->nodes[k] : k;
        if (!set->held[i])
            weights->status[i] =
                iccp_optimise(set->handles, weights->info.method, set->points + set->dim * i,
                              weights->values + set->n_handles * i, work);
    }
    iccp_free(o->memory, work);
    return ICC_OK;
}

static void count_infeasible(icc_weights *weights)
{
    weights->info.n_infeasible = 0;
    for (size_t i = 0; i < weights->nodes->n; ++i)
        weights->info.n_infeasible += weights->status[i] != ICC_OK;
}

icc_status iccp_weights_optimise(icc_weights *weights, size_t n, const uint32_t *nodes,
                                 const iccp_env *env)
{
    optimisation o = {weights, nodes, &env->memory};
    const icc_status status =
        iccp_for_chunks(env, "weights", n, ICCP_NODES_A_TASK, optimise_some, &o);
    count_infeasible(weights);
    return status;
}

/* Ends of lines that are neither handles nor ends of earlier lines are optimised like other nodes.
 * The nodes between them never are. */
static icc_status optimise_ends(icc_weights *weights, const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    const iccp_nodes nodes = iccp_node_set_view(set);
    double *work = iccp_alloc(&env->memory, iccp_optimise_work(set->handles), sizeof *work);
    if (work == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < set->n_lines; ++k) {
        const size_t ends[2] = {set->lines[k].from, set->lines[k].to};
        const size_t first =
            k == 0 ? set->n_handles : set->lines[k - 1].first + set->lines[k - 1].count;
        for (size_t e = 0; e < 2; ++e)
            if (ends[e] >= first)
                weights->status[ends[e]] = iccp_optimise(
                    set->handles, weights->info.method, set->points + set->dim * ends[e],
                    weights->values + set->n_handles * ends[e], work);
        iccp_straighten(&nodes, &set->lines[k], iccp_node_set_parallel(set, k), weights->values);
    }
    iccp_free(&env->memory, work);
    return ICC_OK;
}

static icc_status optimise_each(icc_weights *weights, const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    icc_status status = optimise_ends(weights, env);
    if (status == ICC_OK)
        status = iccp_weights_optimise(weights, set->n, NULL, env);
    for (size_t k = 0; status == ICC_OK && k < set->n_lines; ++k)
        status = iccp_weights_follow_line(weights, k, env);
    return status;
}

/* The ends of lines need weights before the lines can be straight. So with lines, everything is
 * solved twice, first as if there were none. */
static icc_status optimise_together(icc_weights *weights, const iccp_env *env, icc_error *err)
{
    const iccp_node_set *set = weights->nodes;
    const iccp_nodes nodes = iccp_node_set_view(set);
    bool *held = iccp_alloc(&env->memory, set->n, sizeof *held);
    if (held == NULL)
        return iccp_fail_memory(err);
    iccp_biharmonic problem = {.shape = set->sampling->shape,
                               .spacing = set->sampling->info.spacing,
                               .n = set->n,
                               .n_handles = set->n_handles,
                               .nodes = set->given,
                               .held = held};
    iccp_env part[2];
    iccp_split(part, set->n_lines > 0 ? 2 : 1, (const double[]){1, 1}, env);
    for (size_t i = 0; i < set->n; ++i)
        held[i] = set->held[i] && !(i >= set->n_handles && i < set->n_handles + set->n_line_nodes);
    icc_status status = iccp_biharmonic_solve(&problem, weights->values, weights->status,
                                              &weights->info.residual, &part[0], err);
    for (size_t k = 0; status == ICC_OK && k < set->n_lines; ++k)
        iccp_straighten(&nodes, &set->lines[k], iccp_node_set_parallel(set, k), weights->values);
    problem.held = set->held;
    if (status == ICC_OK && set->n_lines > 0)
        status = iccp_biharmonic_solve(&problem, weights->values, weights->status,
                                       &weights->info.residual, &part[1], err);
    iccp_free(&env->memory, held);
    return status;
}

icc_status iccp_weights_start(icc_weights *weights, const iccp_env *env, icc_error *err)
{
    const iccp_node_set *set = weights->nodes;
    const double start = iccp_seconds();
    if (weights->info.method == ICC_WEIGHTS_BIHARMONIC && set->dim != 2)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, "biharmonic weights exist in the plane only");
    memcpy(weights->values, set->initial, set->n * set->n_handles * sizeof *set->initial);
    for (size_t i = 0; i < set->n; ++i)
        weights->status[i] = ICC_OK;
    const icc_status status = weights->info.method == ICC_WEIGHTS_BIHARMONIC
                                  ? optimise_together(weights, env, err)
                                  : optimise_each(weights, env);
    count_infeasible(weights);
    weights->timings.optimise = iccp_seconds() - start;
    return status;
}

/* Columns with the same bits have the same coefficients. */
icc_status iccp_weights_interpolate(icc_weights *weights, const icc_weights *before,
                                    const iccp_env *env)
{
    const iccp_node_set *set = weights->nodes;
    const size_t m = set->n_handles;
    bool *changed = iccp_alloc_zero(&env->memory, m, sizeof *changed);
    if (changed == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < set->n; ++i)
        for (size_t j = 0; j < m; ++j)
            changed[j] |= before == NULL || weights->values[m * i + j] != before->values[m * i + j];
    const icc_status status = iccp_collocation_solve_some(set->collocation, m, weights->values,
                                                          changed, weights->coefficients, env);
    iccp_free(&env->memory, changed);
    return status;
}

/* ---- the object ---- */

/* Allocates everything, but does not fill the arrays. */
static icc_status allocate(icc_weights **out, const iccp_node_set *set, const iccp_env *env)
{
    const size_t n = set->n, m = set->n_handles;
    icc_weights *weights = iccp_alloc_zero(&env->memory, 1, sizeof *weights);
    *out = weights;
    if (weights == NULL)
        return ICC_ERR_MEMORY;
    weights->memory = env->memory;
    weights->nodes = iccp_node_set_retain(set);
    weights->values = iccp_alloc(&weights->memory, n, m * sizeof *weights->values);
    weights->status = iccp_alloc(&weights->memory, n, sizeof *weights->status);
    weights->coefficients =
        iccp_alloc(&weights->memory, n + set->dim + 1, m * sizeof *weights->coefficients);
    return weights->values != NULL && weights->status != NULL && weights->coefficients != NULL
               ? ICC_OK
               : ICC_ERR_MEMORY;
}

static void describe(icc_weights *weights, const icc_weights_options *options)
{
    const iccp_node_set *set = weights->nodes;
    weights->info.dim = (int32_t)set->dim;
    weights->info.kernel = options->kernel;
    weights->info.initial = options->initial;
    weights->info.method = options->method;
    weights->info.sigma = options->sigma;
    weights->info.n_handles = set->n_handles;
    weights->info.n_nodes = set->n;
    weights->info.n_entries = iccp_collocation_entries(set->collocation);
    weights->info.definiteness = iccp_collocation_definiteness(set->collocation);
}

static icc_status create_at_nodes(icc_weights **out, iccp_node_set *set,
                                  const icc_weights_options *options, const iccp_env *env,
                                  icc_error *err)
{
    const double start = iccp_seconds();
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){1, 4, 2}, env);
    icc_status status = initialise(set, options, &part[0]);
    const double seconds = iccp_seconds() - start;
    if (status == ICC_OK)
        status = allocate(out, set, env);
    if (status != ICC_OK)
        return status;
    describe(*out, options);
    (*out)->timings.initial = seconds;
    status = iccp_weights_start(*out, &part[1], err);
    return status == ICC_OK ? iccp_weights_interpolate(*out, NULL, &part[2]) : status;
}

icc_status iccp_weights_create(icc_weights **out, const icc_sampling *sampling, size_t n_handles,
                               const double *handles, const icc_weights_options *options,
                               const iccp_env *env, icc_error *err)
{
    iccp_node_set *set;
    const double start = iccp_seconds();
    *out = NULL;
    const iccp_env weights = iccp_part(env, "weights", 0, 1);
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 2}, &weights);
    icc_status status =
        iccp_node_set_create(&set, sampling, n_handles, handles, options, &part[0], err);
    const double seconds = iccp_seconds() - start;
    if (status == ICC_OK)
        status = create_at_nodes(out, set, options, &part[1], err);
    iccp_node_set_release(set);
    if (status == ICC_OK)
        (*out)->timings.factor = seconds;
    if (status == ICC_OK)
        return ICC_OK;
    iccp_weights_release(*out);
    *out = NULL;
    return status;
}

icc_status iccp_weights_copy(icc_weights **out, const icc_weights *from, const iccp_env *env)
{
    const iccp_node_set *set = from->nodes;
    const icc_status status = allocate(out, set, env);
    if (status != ICC_OK) {
        iccp_weights_release(*out);
        *out = NULL;
        return status;
    }
    icc_weights *weights = *out;
    weights->info = from->info;
    weights->timings = from->timings;
    weights->info.residual = 0;
    memcpy(weights->values, from->values, set->n * set->n_handles * sizeof *from->values);
    memcpy(weights->status, from->status, set->n * sizeof *from->status);
    memcpy(weights->coefficients, from->coefficients,
           (set->n + set->dim + 1) * set->n_handles * sizeof *from->coefficients);
    return ICC_OK;
}

void iccp_weights_release(icc_weights *weights)
{
    if (weights == NULL)
        return;
    iccp_node_set_release(weights->nodes);
    iccp_free(&weights->memory, weights->values);
    iccp_free(&weights->memory, weights->status);
    iccp_free(&weights->memory, weights->coefficients);
    const iccp_memory memory = weights->memory;
    iccp_free(&memory, weights);
}
