/* Checks the arguments of the functions that solve for a function of a tree. */
#include "api/check.h"
#include "api/new_function.h"
#include "base/error.h"
#include "base/options.h"
#include "gradient/function/given_equation.h"
#include "gradient/function/given_function.h"
#include "gradient/function/make_function.h"
#include "icc/stages.h"

#include <math.h>

icc_status icc_function_create(icc_function **out, const icc_tree *tree,
                               const icc_function_options *options, const icc_env *env,
                               icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : tree == NULL ? "tree" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_function_options full;
    status = iccp_read_struct(&full, sizeof full, options, "icc_function_options", err);
    if (status != ICC_OK)
        return status;
    status = iccp_check_function(&full, "icc_function_options", err);
    if (status != ICC_OK)
        return status;
    status = iccp_with_logs(out, iccp_function_create(out, tree, &full, &full_env, err), err);
    return iccp_end_function(status, out, &full_env, err);
}

static icc_status check_equation(const icc_function_options *options, icc_error *err)
{
    if (options->function != ICC_FUNCTION_LAPLACE && options->function != ICC_FUNCTION_BILAPLACE)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "only laplace and bilaplace take fixed values and a right-hand side");
    if (options->constraints != 0 && options->constraints != ICC_CONSTRAINTS_NONE)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "fixed values and a right-hand side exclude the tree's inequalities");
    if (options->solver == ICC_SOLVER_ITERATIVE)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED,
                         "fixed values and a right-hand side need the direct solver");
    return ICC_OK;
}

/* Checks that fixed values are NaN or not too large, and the right-hand side at free vertices
 * finite. */
static icc_status check_numbers(const icc_tree *tree, const double *fixed, const double *right_side,
                                icc_error *err)
{
    for (size_t v = 0; fixed != NULL && v < tree->grid->n_vertices; ++v)
        if (fabs(fixed[v]) > ICCP_MAX_VALUE)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, (uint32_t)v,
                                "the fixed value of vertex %lu is %g; it must be at most 2^900",
                                (unsigned long)v, fixed[v]);
    for (size_t i = 0; right_side != NULL && i < tree->n_inside; ++i) {
        const uint32_t v = tree->order[i];
        if (!isfinite(right_side[v]) && (fixed == NULL || isnan(fixed[v])))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, v,
                                "the right-hand side of vertex %lu is %g; it must be finite",
                                (unsigned long)v, right_side[v]);
    }
    return ICC_OK;
}

icc_status icc_function_create_solve(icc_function **out, const icc_tree *tree,
                                     const icc_function_options *options, const double *fixed,
                                     const double *right_side, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    icc_function_options full;
    const char *missing = out == NULL ? "out" : tree == NULL ? "tree" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&full, sizeof full, options, "icc_function_options", err);
    if (status == ICC_OK)
        status = iccp_check_function(&full, "icc_function_options", err);
    if (status != ICC_OK)
        return status;
    full.function = full.function != 0 ? full.function : ICC_FUNCTION_LAPLACE;
    status = check_equation(&full, err);
    if (status == ICC_OK)
        status = check_numbers(tree, fixed, right_side, err);
    if (status != ICC_OK)
        return status;
    status = iccp_function_solve(out, tree, full.function, fixed, right_side, &full_env);
    if (status == ICC_ERR_SOLVER)
        return iccp_fail(err, status,
                         "the values are too large for doubles, or rounding spoils them");
    return iccp_end_function(iccp_with_logs(out, status, err), out, &full_env, err);
}
