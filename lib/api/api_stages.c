/* Checks the arguments of the functions on single stages: grid, tree, function and
 * triangulation. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/domain.h"
#include "domain/features.h"
#include "gradient/function/critical_points.h"
#include "gradient/function/edges.h"
#include "gradient/function/make_function.h"
#include "gradient/grid/grassfire.h"
#include "gradient/grid/lattice.h"
#include "gradient/grid/rasterise.h"
#include "gradient/grid/refine.h"
#include "gradient/tree/cousin.h"
#include "gradient/tree/grow.h"
#include "gradient/tree/ranks.h"
#include "gradient/tree/verify.h"
#include "icc/stages.h"
#include "mesh/triangulate.h"

#include <math.h>
#include <string.h>

ICCP_END(grid)
ICCP_END(tree)
ICCP_END(function)

static const int32_t DEFAULT_CELLS = 50;          /* from the papers */
static const size_t MAX_POINTS = UINT32_MAX / 16; /* the corners of triangles also need numbers of
                                                     32 bits */

/* -------------------------------------------------------------------- grid */

icc_status icc_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                           const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : domain == NULL ? "domain" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_features_refuse(domain, "the domain of a grid", err);
    if (status != ICC_OK)
        return status;
    if (cells == 0)
        cells = domain->mask == NULL ? DEFAULT_CELLS : 2;
    if (cells < ICCP_MIN_CELLS || cells > ICCP_MAX_CELLS)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "cells is %ld; it must lie in 2..%ld", (long)cells,
                         (long)ICCP_MAX_CELLS);
    return iccp_end_grid(iccp_explain(err, iccp_grid_create(out, domain, cells, &full_env, err)),
                         out, &full_env, err);
}

icc_status icc_grid_create_mask(icc_grid **out, int32_t dim, const size_t *shape,
                                const uint8_t *inside, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL      ? "out"
                          : shape == NULL  ? "shape"
                          : inside == NULL ? "inside"
                                           : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (dim < 1 || dim > ICC_MAX_DIM)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "dim is %ld; it must lie in 1..%d", (long)dim,
                         ICC_MAX_DIM);
    for (int32_t k = 0; k < dim; ++k)
        if (shape[k] == 0)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_AXIS, k, "shape[%ld] is 0",
                                (long)k);
    return iccp_end_grid(
        iccp_explain(err, iccp_grid_create_mask(out, dim, shape, inside, &full_env, err)), out,
        &full_env, err);
}

icc_status icc_grid_refine(icc_grid **out, const icc_grid *grid, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : grid == NULL ? "grid" : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_grid(iccp_explain(err, iccp_grid_refine(out, grid, &full_env, err)), out,
                         &full_env, err);
}

icc_status icc_grid_restrict(icc_grid **out, const icc_grid *grid, const uint8_t *keep,
                             const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL    ? "out"
                          : grid == NULL ? "grid"
                          : keep == NULL ? "keep"
                                         : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_grid(iccp_explain(err, iccp_grid_restrict(out, grid, keep, &full_env, err)),
                         out, &full_env, err);
}

void icc_grid_free(icc_grid *grid)
{
    iccp_grid_release(grid);
}

icc_status icc_grid_get_info(const icc_grid *grid, icc_grid_info *info)
{
    ICCP_ENTER;
    if (grid == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    icc_grid_info full = {.dim = grid->dim,
                          .spacing = grid->spacing * grid->frame.out[0] * grid->frame.out[1],
                          .n_vertices = grid->n_vertices,
                          .n_inside = grid->n_inside,
                          .n_stray = grid->n_stray,
                          .cells = grid->cells};
    iccp_frame_out(&grid->frame, grid->dim, grid->origin, full.origin);
    for (int32_t k = 0; k < grid->dim; ++k)
        full.shape[k] = grid->shape[k];
    return iccp_write_struct(info, &full, sizeof full, "icc_grid_info", NULL);
}

const uint8_t *icc_grid_inside(const icc_grid *grid)
{
    return grid != NULL ? grid->inside : NULL;
}

icc_status icc_grid_find_maximum(const icc_grid *grid, uint32_t *vertex, uint32_t *rounds,
                                 const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = grid == NULL ? "grid" : vertex == NULL ? "vertex" : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    return iccp_explain(
        err, iccp_finish(&full_env, iccp_grassfire(grid, vertex, rounds, &full_env, err)));
}

icc_status icc_grid_find_nearest(const icc_grid *grid, const double *point, uint32_t *vertex)
{
    ICCP_ENTER;
    if (grid == NULL || point == NULL || vertex == NULL)
        return ICC_ERR_ARGUMENT;
    for (int32_t k = 0; k < grid->dim; ++k)
        if (!isfinite(point[k]))
            return ICC_ERR_ARGUMENT;
    double local[ICC_MAX_DIM];
    iccp_frame_in(&grid->frame, grid->dim, point, local);
    *vertex = iccp_grid_nearest(grid, local);
    return *vertex != ICCP_NONE ? ICC_OK : ICC_ERR_RESOLUTION;
}

/* -------------------------------------------------------------------- tree */

/* Checks that the order is a permutation of the dim axes. NULL stands for the given order. */
static icc_status check_axis_order(const int32_t *order, int32_t dim, icc_error *err)
{
    if (order == NULL)
        return ICC_OK;
    uint32_t seen = 0;
    for (int32_t k = 0; k < dim; ++k) {
        if (order[k] < 0 || order[k] >= dim || (seen >> order[k] & 1) != 0)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_AXIS, k,
                                "axis_order is not a permutation of 0..%ld: entry %ld is %ld",
                                (long)dim - 1, (long)k, (long)order[k]);
        seen |= (uint32_t)1 << order[k];
    }
    return ICC_OK;
}

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
    return check_axis_order(full->axis_order, dim, err);
}

icc_status icc_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root,
                           const icc_tree_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : grid == NULL ? "grid" : NULL;
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
    return iccp_end_tree(iccp_explain(err, iccp_tree_create(out, grid, root, full.form,
                                                            full.axis_order, &full_env, err)),
                         out, &full_env, err);
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

/* ------------------------------------------------------------------- function */

/* Creates a function and its logarithms, so that icc_function_logs() cannot fail. */
static icc_status create_function(icc_function **out, const icc_tree *tree,
                                  const icc_function_options *options, const iccp_env *env,
                                  icc_error *err)
{
    const icc_status status = iccp_function_create(out, tree, options, env, err);
    if (status != ICC_OK || !(*out)->has_logs || iccp_function_logs(*out) != NULL)
        return status;
    iccp_function_release(*out);
    *out = NULL;
    return iccp_fail_memory(err);
}

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
    return status == ICC_OK ? iccp_end_function(create_function(out, tree, &full, &full_env, err),
                                                out, &full_env, err)
                            : status;
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

icc_status icc_function_get_edges(const icc_function *function, size_t capacity, uint32_t *edges,
                                  int32_t *kinds, size_t *n_edges, size_t *n_tested)
{
    ICCP_ENTER;
    if (function == NULL || n_edges == NULL || (capacity > 0 && (edges == NULL || kinds == NULL)))
        return ICC_ERR_ARGUMENT;
    if (function->tree->grid->dim != 2)
        return ICC_ERR_UNSUPPORTED;
    const iccp_edge_count count = iccp_function_edges(function, capacity, edges, kinds);
    *n_edges = count.n_compression + count.n_expansion;
    if (n_tested != NULL)
        *n_tested = count.n_tested;
    return ICC_OK;
}

/* ----------------------------------------------------------- triangulation */

/* Converts the inner points to the polygon's local coordinates. Points within its bounding box
 * are shifted and scaled as exactly as its vertices (geometry/frame.h). */
static icc_status localise(double *local, const icc_domain *polygon, size_t n_points,
                           const double *points, icc_error *err)
{
    for (size_t i = polygon->n_vertices; i < n_points; ++i) {
        const double *p = points + 2 * i;
        if (!isfinite(p[0]) || !isfinite(p[1]))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "point %zu is not finite", i);
        iccp_frame_in(&polygon->frame, 2, p, local + 2 * i);
        for (int k = 0; k < 2; ++k)
            if (local[2 * i + (size_t)k] < polygon->lower[k] ||
                local[2 * i + (size_t)k] > polygon->upper[k])
                return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, (int64_t)i,
                                    "point %zu (%.17g, %.17g) is not inside the polygon", i, p[0],
                                    p[1]);
        if (!iccp_frame_holds(&polygon->frame, 2, p))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "point %zu (%.17g, %.17g): a coordinate is not 0, but less than "
                                "2^-200 of the largest one",
                                i, p[0], p[1]);
    }
    return ICC_OK;
}

static icc_status triangulate(const icc_domain *polygon, size_t n_points, const double *points,
                              uint32_t *triangles, const iccp_env *env, icc_error *err)
{
    double *local = iccp_alloc(&env->memory, n_points, 2 * sizeof *local);
    if (local == NULL)
        return iccp_fail_memory(err);
    for (size_t i = 0; i < 2 * polygon->n_vertices; ++i)
        local[i] = polygon->vertices[i];
    icc_status status = localise(local, polygon, n_points, points, err);
    if (status == ICC_OK)
        status = iccp_triangulate(polygon->n_vertices, n_points, local, triangles, env, err);
    iccp_free(&env->memory, local);
    return status;
}

icc_status icc_triangulate(size_t n_boundary, size_t n_points, const double *points,
                           uint32_t *triangles, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = points == NULL ? "points" : triangles == NULL ? "triangles" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (n_boundary < 3 || n_points < n_boundary || n_points > MAX_POINTS)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "a polygon of %zu vertices among %zu points: at least 3 vertices, and at "
                         "most %zu points",
                         n_boundary, n_points, MAX_POINTS);
    icc_domain *polygon;
    status = iccp_domain_create(&polygon, 2, n_boundary, points, 0, NULL, &full_env, err);
    if (status == ICC_OK)
        status = triangulate(polygon, n_points, points, triangles, &full_env, err);
    iccp_domain_release(polygon);
    return iccp_explain(err, iccp_finish(&full_env, status));
}
