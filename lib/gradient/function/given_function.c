/* Takes values of the caller's. What is missing outside goes on as the function falls inside, so
 * that its curves can meet the boundary. */
#include "gradient/function/given_function.h"

#include "base/minmax.h"
#include "gradient/function/extrapolate.h"
#include "math/elementary.h"

#include <math.h>

static icc_status begin(icc_function **out, const icc_tree *tree, const iccp_env *env)
{
    const icc_status status = iccp_function_new(out, tree, env);
    if (status == ICC_OK)
        (*out)->info.function = (*out)->made.function = ICC_FUNCTION_VALUES;
    return status;
}

/* Counts the edges of the tree inside along which the function does not fall. */
static void count_violations(icc_function *function)
{
    const icc_tree *tree = function->tree;
    for (size_t i = 1; i < tree->n_inside; ++i) {
        const uint32_t v = tree->order[i];
        function->info.n_violated += iccp_function_compare(function, tree->parent[v], v) <= 0;
    }
}

static icc_status finish(icc_function **out, icc_status status)
{
    if (status == ICC_OK) {
        count_violations(*out);
        iccp_function_find_highest(*out);
        return ICC_OK;
    }
    iccp_function_release(*out);
    *out = NULL;
    return status;
}

/* ---- values ---- */

/* Returns the lowest vertex inside next to an outside vertex, or ICCP_NONE. */
static uint32_t lowest_beside(const icc_function *function, uint32_t v)
{
    const icc_tree *tree = function->tree;
    uint32_t best = ICCP_NONE;
    for (int32_t d = 0; d < 2 * tree->grid->dim; ++d) {
        const uint32_t u = iccp_grid_neighbour(tree->grid, v, d / 2, d % 2 * 2 - 1);
        if (u != ICCP_NONE && tree->grid->inside[u] && tree->generation[u] >= 0 &&
            (best == ICCP_NONE || iccp_function_compare(function, u, best) < 0))
            best = u;
    }
    return best;
}

/* Sets the missing values in two passes: next to the inside, then in the layer behind. The root has
 * no parent; next to it, the function falls to the least value inside, or by 1 if that is the
 * root's. */
static void extend(icc_function *function, const double *given)
{
    const icc_tree *tree = function->tree;
    double *f = function->values, least = f[tree->root];
    for (size_t i = 0; i < tree->n_inside; ++i)
        least = iccp_min(least, f[tree->order[i]]);
    for (size_t i = tree->n_inside; i < tree->n_reached; ++i) {
        const uint32_t v = tree->order[i], u = lowest_beside(function, v);
        f[v] = given[v];
        if (!isnan(f[v]) || u == ICCP_NONE)
            continue;
        if (u != tree->root)
            f[v] = 2 * f[u] - f[tree->parent[u]];
        else
            f[v] = least < f[u] ? least : f[u] - 1;
    }
    for (size_t i = tree->n_inside; i < tree->n_reached; ++i)
        if (isnan(f[tree->order[i]]))
            iccp_function_extend_line(function, tree->order[i]);
}

icc_status iccp_function_create_values(icc_function **out, const icc_tree *tree,
                                       const double *values, const iccp_env *env)
{
    const icc_status status = begin(out, tree, env);
    if (status != ICC_OK)
        return status;
    icc_function *function = *out;
    function->has_logs = true;
    for (size_t i = 0; i < tree->n_inside; ++i) {
        const uint32_t v = tree->order[i];
        function->values[v] = values[v];
        function->has_logs = function->has_logs && values[v] > 0;
    }
    if (function->has_logs)
        function->info.least_log = iccp_function_log(function, tree->root);
    for (size_t i = 1; function->has_logs && i < tree->n_inside; ++i)
        function->info.least_log =
            iccp_min(function->info.least_log, iccp_function_log(function, tree->order[i]));
    extend(function, values);
    return finish(out, ICC_OK);
}

/* ---- logarithms ---- */

/* e^log as a fraction in [0.5, 1) and an exponent. */
static void set_scaled(const iccp_scaled *f, size_t k, double log)
{
    const double ln_2 = iccp_ln(2), power = floor(log / ln_2);
    iccp_scaled_set(f, k, iccp_exp(log - power * ln_2), (int32_t)power);
}

/* Makes a function from logarithms, or from fractions and exponents, whichever is not NULL. */
static icc_status create_scaled(icc_function **out, const icc_tree *tree, const double *logs,
                                const iccp_scaled *given, const iccp_env *env)
{
    iccp_unknowns unknowns;
    icc_status status = begin(out, tree, env);
    if (status != ICC_OK)
        return status;
    (*out)->from_logs = true;
    status = iccp_unknowns_create(&unknowns, tree, env);
    if (status != ICC_OK)
        return finish(out, status);
    const iccp_scaled f = {iccp_alloc(&env->memory, unknowns.n, sizeof *f.fraction),
                           iccp_alloc(&env->memory, unknowns.n, sizeof *f.exponent)};
    status = f.fraction != NULL && f.exponent != NULL ? ICC_OK : ICC_ERR_MEMORY;
    for (size_t k = 0; status == ICC_OK && k < unknowns.n; ++k) {
        const uint32_t v = unknowns.vertex[k];
        if (logs != NULL)
            set_scaled(&f, k, logs[v]);
        else
            iccp_scaled_set(&f, k, given->fraction[v], given->exponent[v]);
    }
    if (status == ICC_OK)
        status = iccp_function_assign(*out, &unknowns, &f);
    iccp_free(&env->memory, f.fraction);
    iccp_free(&env->memory, f.exponent);
    iccp_unknowns_free(&unknowns);
    return finish(out, status);
}

icc_status iccp_function_create_logs(icc_function **out, const icc_tree *tree, const double *logs,
                                     const iccp_env *env)
{
    return create_scaled(out, tree, logs, NULL, env);
}

icc_status iccp_function_create_scaled(icc_function **out, const icc_tree *tree,
                                       const iccp_scaled *given, const iccp_env *env)
{
    return create_scaled(out, tree, NULL, given, env);
}
