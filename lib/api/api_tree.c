/* Checks the arguments of the functions on trees and on orders of their vertices. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "gradient/tree/cousin.h"
#include "gradient/tree/grow.h"
#include "gradient/tree/ranks.h"
#include "gradient/tree/verify.h"
#include "icc/stages.h"

#include <math.h>

ICCP_END(tree)

static icc_status read_tree_options(icc_tree_options *full, const icc_tree_options *options,
                                    int32_t dim, icc_error *err)
{
    const icc_status status =
        iccp_read_struct(full, sizeof *full, options, "icc_tree_options", err);
    if (status != ICC_OK)
        return status;
    if (full->form == 0)
        full->form = ICC_TREE_THESIS;
    if (full->form != ICC_TREE_THESIS && full->form != ICC_TREE_PAPER)
        return iccp_fail(
            err, ICC_ERR_ARGUMENT,
            "icc_tree_options.form is %ld; it must be ICC_TREE_THESIS or ICC_TREE_PAPER",
            (long)full->form);
    return iccp_check_axis_order(full->axis_order, dim, err);
}

/* Creates a tree, with the caller's parents unless they are NULL. `missing` is the name of a
 * required argument that is NULL, besides `out` and `grid`. */
static icc_status create_tree(icc_tree **out, const icc_grid *grid, uint32_t root,
                              const uint32_t *parents, const char *missing,
                              const icc_tree_options *options, const icc_env *env, icc_error *err)
{
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    missing = out == NULL ? "out" : grid == NULL ? "grid" : missing;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_tree_options full;
    status = read_tree_options(&full, options, grid->dim, err);
    if (status != ICC_OK)
        return status;
    if (root >= grid->n_vertices || !grid->inside[root])
        return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, root,
                            "the root, vertex %lu, is not inside", (unsigned long)root);
    status = iccp_tree_create_parents(out, grid, root, parents, full.form, full.axis_order,
                                      &full_env, err);
    return iccp_end_tree(iccp_explain(err, status), out, &full_env, err);
}

icc_status icc_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root,
                           const icc_tree_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    return create_tree(out, grid, root, NULL, NULL, options, env, err);
}

icc_status icc_tree_create_parents(icc_tree **out, const icc_grid *grid, uint32_t root,
                                   const uint32_t *parents, const icc_tree_options *options,
                                   const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    const char *missing = out != NULL && grid != NULL && parents == NULL ? "parents" : NULL;
    return create_tree(out, grid, root, parents, missing, options, env, err);
}

void icc_tree_free(icc_tree *tree)
{
    iccp_tree_release(tree);
}

const icc_grid *icc_tree_grid(const icc_tree *tree)
{
    return tree != NULL ? tree->grid : NULL;
}

uint32_t icc_tree_root(const icc_tree *tree)
{
    return tree != NULL ? tree->root : ICCP_NONE;
}

const uint32_t *icc_tree_parents(const icc_tree *tree)
{
    return tree != NULL ? tree->parent : NULL;
}

const int32_t *icc_tree_generations(const icc_tree *tree)
{
    return tree != NULL ? tree->generation : NULL;
}

icc_status icc_tree_get_report(const icc_tree *tree, icc_tree_report *report, const icc_env *env,
                               icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = tree == NULL ? "tree" : report == NULL ? "report" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_tree_report full;
    status = iccp_explain(err, iccp_finish(&full_env, iccp_tree_verify(tree, &full, &full_env)));
    if (status != ICC_OK)
        return status;
    return iccp_write_struct(report, &full, sizeof full, "icc_tree_report", err);
}

/* Checks the values at the grid's vertices. Only those of the tree's vertices count, in its
 * order. */
static icc_status check_values(const icc_tree *tree, const double *values, icc_error *err)
{
    for (size_t i = 0; values != NULL && i < tree->n_inside; ++i)
        if (isnan(values[tree->order[i]]))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_GRID_VERTEX, tree->order[i],
                                "the value of vertex %lu is NaN", (unsigned long)tree->order[i]);
    return ICC_OK;
}

icc_status icc_tree_grow(const icc_tree *tree, const double *values, uint32_t *rank,
                         icc_grow_report *report, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = tree == NULL ? "tree" : rank == NULL ? "rank" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = check_values(tree, values, err);
    if (status != ICC_OK)
        return status;
    icc_grow_report full;
    status = iccp_tree_grow(tree, values, rank, &full, &full_env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_finish(&full_env, ICC_OK));
    if (report == NULL || (status != ICC_OK && status != ICC_ERR_TOPOLOGY))
        return status;
    const icc_status written =
        iccp_write_struct(report, &full, sizeof full, "icc_grow_report", err);
    return written != ICC_OK ? written : status;
}

icc_status icc_tree_get_rank_report(const icc_tree *tree, const uint32_t *rank,
                                    icc_function_report *report, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = tree == NULL     ? "tree"
                          : rank == NULL   ? "rank"
                          : report == NULL ? "report"
                                           : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    icc_function_report full;
    status = iccp_explain(
        err, iccp_finish(&full_env, iccp_tree_verify_ranks(tree, rank, &full, &full_env)));
    if (status != ICC_OK)
        return status;
    return iccp_write_struct(report, &full, sizeof full, "icc_function_report", err);
}
