/* Checks the arguments of the functions that take a function of a tree from the caller, or ask it
 * something. */
#include "api/check.h"
#include "api/new_function.h"
#include "base/error.h"
#include "base/options.h"
#include "gradient/function/critical_points.h"
#include "gradient/function/given_function.h"
#include "gradient/function/merging.h"
#include "icc/stages.h"

#include <math.h>
#include <string.h>

/* Checks the caller's values, or logarithms, whose exponents must fit into 32 bits. Only those of
 * the tree's first n vertices count. Values outside may be NaN. */
static icc_status check_given(const icc_tree *tree, size_t n, const double *given, double largest,
                              const char *what, icc_error *err)
{
    for (size_t i = 0; i < n; ++i)
        if (!(fabs(given[tree->order[i]]) <= largest) &&
            !(i >= tree->n_inside && isnan(given[tree->order[i]])))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, tree->order[i],
                                "the %s of vertex %lu is %g; it must be finite and at most %g in "
                                "size",
                                what, (unsigned long)tree->order[i], given[tree->order[i]],
                                largest);
    return ICC_OK;
}

typedef icc_status (*create_given)(icc_function **out, const icc_tree *tree, const double *given,
                                   const iccp_env *env);

static icc_status take_given(icc_function **out, const icc_tree *tree, const double *given,
                             create_given create, const icc_env *env, icc_error *err)
{
    const bool logs = create == iccp_function_create_logs;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL     ? "out"
                          : tree == NULL  ? "tree"
                          : given == NULL ? (logs ? "logs" : "values")
                                          : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = check_given(tree, logs ? tree->n_inside : tree->n_reached, given,
                             logs ? -ICCP_ZERO_EXPONENT / 2 : ICCP_MAX_VALUE,
                             logs ? "logarithm" : "value", err);
    if (status != ICC_OK)
        return status;
    status = iccp_with_logs(out, create(out, tree, given, &full_env), err);
    return iccp_end_function(status, out, &full_env, err);
}

icc_status icc_function_create_values(icc_function **out, const icc_tree *tree,
                                      const double *values, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    return take_given(out, tree, values, iccp_function_create_values, env, err);
}

icc_status icc_function_create_logs(icc_function **out, const icc_tree *tree, const double *logs,
                                    const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    return take_given(out, tree, logs, iccp_function_create_logs, env, err);
}

void icc_function_free(icc_function *function)
{
    iccp_function_release(function);
}

const double *icc_function_values(const icc_function *function)
{
    ICCP_ENTER;
    if (function == NULL)
        return NULL;
    return function->plain != NULL ? function->plain : function->values;
}

const double *icc_function_logs(const icc_function *function)
{
    ICCP_ENTER;
    return function != NULL ? iccp_function_logs(function) : NULL;
}

icc_status icc_function_get_info(const icc_function *function, icc_function_info *info)
{
    ICCP_ENTER;
    if (function == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_solution *s = &function->info;
    /* Zeros the bytes behind the last member, too, so that equal infos have equal bytes. */
    icc_function_info full;
    memset(&full, 0, sizeof full);
    full.function = s->function;
    full.constrained = s->constrained;
    full.solver = s->solver;
    full.beside = s->beside;
    full.n_unknowns = s->n_unknowns;
    full.n_violated = s->n_violated;
    full.n_active = s->n_active;
    full.residual = s->residual;
    full.least_log = s->least_log;
    full.excess = s->excess;
    full.highest = s->highest;
    return iccp_write_struct(info, &full, sizeof full, "icc_function_info", NULL);
}

icc_status icc_function_get_solver_report(const icc_function *function, icc_solver_report *report)
{
    ICCP_ENTER;
    if (function == NULL || report == NULL)
        return ICC_ERR_ARGUMENT;
    const iccp_solution *s = &function->info;
    const icc_solver_report full = {.n_iterations = s->n_iterations,
                                    .n_inner = s->n_inner,
                                    .work = s->work,
                                    .residual_before = s->residual_before,
                                    .seconds_setup = s->seconds_setup,
                                    .seconds_order = s->seconds_order,
                                    .seconds_factor = s->seconds_factor,
                                    .seconds_solve = s->seconds_solve,
                                    .seconds_verify = s->seconds_verify};
    return iccp_write_struct(report, &full, sizeof full, "icc_solver_report", NULL);
}

const icc_tree *icc_function_tree(const icc_function *function)
{
    return function != NULL ? function->tree : NULL;
}

icc_status icc_function_get_report(const icc_function *function, icc_function_report *report,
                                   const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = function == NULL ? "function" : report == NULL ? "report" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_function_report full;
    status =
        iccp_explain(err, iccp_finish(&full_env, iccp_function_verify(function, &full, &full_env)));
    if (status != ICC_OK)
        return status;
    return iccp_write_struct(report, &full, sizeof full, "icc_function_report", err);
}

icc_status icc_function_get_facets(const icc_function *function, size_t capacity, uint32_t *facets,
                                   int32_t *kinds, icc_facet_report *report, const icc_env *env,
                                   icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const bool no_room = capacity > 0 && (facets == NULL || kinds == NULL);
    const char *missing = function == NULL ? "function"
                          : report == NULL ? "report"
                          : no_room        ? (facets == NULL ? "facets" : "kinds")
                                           : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    iccp_facet_count count;
    status = iccp_function_facets(function, capacity, facets, kinds, &count, &full_env);
    status = iccp_explain(err, iccp_finish(&full_env, status));
    if (status != ICC_OK)
        return status;
    const icc_facet_report full = {.n_tested = count.n_tested,
                                   .n_compression = count.n_compression,
                                   .n_expansion = count.n_expansion};
    return iccp_write_struct(report, &full, sizeof full, "icc_facet_report", err);
}

icc_status icc_function_get_edges(const icc_function *function, size_t capacity, uint32_t *edges,
                                  int32_t *kinds, size_t *n_edges, size_t *n_tested)
{
    ICCP_ENTER;
    if (function == NULL || n_edges == NULL || (capacity > 0 && (edges == NULL || kinds == NULL)))
        return ICC_ERR_ARGUMENT;
    if (function->tree->grid->dim != 2)
        return ICC_ERR_UNSUPPORTED;
    iccp_facet_count count;
    const iccp_env env = {.memory = function->memory};
    const icc_status status = iccp_function_facets(function, capacity, edges, kinds, &count, &env);
    if (status != ICC_OK)
        return status;
    *n_edges = count.n_compression + count.n_expansion;
    if (n_tested != NULL)
        *n_tested = count.n_tested;
    return ICC_OK;
}
