/* Makes the stages of a gradient chart. Based on: L. Huynh, thesis, 2013, section 5.1, Algorithm 6,
 * and sections 4.1 and 5.2. */
#include "gradient/coordinates/gradient_stages.h"

#include "base/clock.h"
#include "base/error.h"
#include "gradient/function/critical_points.h"
#include "gradient/function/make_function.h"
#include "gradient/function/move_maximum.h"
#include "gradient/grid/grassfire.h"
#include "gradient/grid/rasterise.h"

/* ---- grid and maximum ---- */

static icc_status choose_root(const icc_grid *grid, const icc_domain *domain, const double *maximum,
                              uint32_t *root, const iccp_env *env, icc_error *err)
{
    if (maximum == NULL)
        return iccp_grassfire(grid, root, NULL, env, err);
    double local[ICC_MAX_DIM];
    iccp_frame_in(&domain->frame, domain->dim, maximum, local);
    if (iccp_domain_locate(domain, local, true, NULL, NULL) != ICC_INSIDE)
        return iccp_fail(err, ICC_ERR_OUTSIDE, "the maximum is not inside the domain");
    *root = iccp_grid_nearest(grid, local);
    return ICC_OK;
}

enum { PAPERS_CELLS = 50 };

/* Masks determine the number of cells themselves. */
static int32_t choose_cells(const icc_domain *domain, int32_t cells)
{
    return cells > 0 || domain->mask != NULL ? cells : PAPERS_CELLS;
}

/* ---- tree ---- */

/* A tree and the function on it, while they are made. */
typedef struct stages {
    icc_tree *tree;
    icc_function *function;
    uint32_t chosen; /* the first root */
    const icc_chart_options *options;
    icc_chart_timings *timings;
} stages;

/* Grows a tree, which replaces the present one, if any. */
static icc_status grow_tree(stages *s, const icc_grid *grid, uint32_t root, const iccp_env *env,
                            icc_error *err)
{
    const double start = iccp_seconds();
    icc_tree *tree = NULL;
    const icc_status status =
        iccp_tree_create(&tree, grid, root, s->options->tree, s->options->axis_order, env, err);
    if (status == ICC_OK) {
        iccp_tree_release(s->tree);
        s->tree = tree;
    }
    s->timings->tree += iccp_seconds() - start;
    return status;
}

/* Algorithms 1 and 2: makes the grid, finds the grassfire's maximum unless the caller gave one, and
 * grows the tree. */
static icc_status make_tree(stages *s, const icc_domain *domain, const iccp_env *env,
                            icc_error *err)
{
    icc_grid *grid = NULL;
    const double start = iccp_seconds();
    const int32_t cells = choose_cells(domain, s->options->cells);
    iccp_env part[3];
    iccp_split(part, 3, (const double[]){3, 1, 5}, env);
    icc_status status = iccp_grid_create(&grid, domain, cells, &part[0], err);
    if (status != ICC_OK)
        return status;
    status = choose_root(grid, domain, s->options->maximum, &s->chosen, &part[1], err);
    s->timings->grid += iccp_seconds() - start;
    if (status == ICC_OK)
        status = grow_tree(s, grid, s->chosen, &part[2], err);
    iccp_grid_release(grid);
    return status;
}

/* ---- function ---- */

/* Makes a function without inequalities on a tree with another root. */
static icc_status move_root(stages *s, uint32_t root, const icc_function_options *function,
                            const iccp_env *env, icc_error *err)
{
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 4}, env);
    const icc_status status = grow_tree(s, s->tree->grid, root, &part[0], err);
    iccp_function_release(s->function);
    s->function = NULL;
    return status == ICC_OK ? iccp_function_create(&s->function, s->tree, function, &part[1], err)
                            : status;
}

/* Makes a plate (bi-Laplace) function. A plate is highest beside a load that is not in its middle,
 * and curves would end there instead of at the root. Without inequalities, the root moves to where
 * it is the maximum. If the function then still has false critical points, inequalities are imposed
 * at the root that the caller asked for. */
static icc_status make_plate(stages *s, const icc_function_options *options, const iccp_env *env,
                             icc_error *err)
{
    icc_function_options function = *options;
    bool enough = options->constraints == ICC_CONSTRAINTS_NONE;
    function.constraints = ICC_CONSTRAINTS_NONE;
    iccp_env part[5];
    iccp_split(part, 5, (const double[]){4, 4, 3, 1, enough ? 0 : 8}, env);
    icc_status status = iccp_function_create(&s->function, s->tree, &function, &part[0], err);
    if (status == ICC_OK && s->function->info.beside) {
        uint32_t maximum = 0;
        status = iccp_function_move_maximum(s->function, &maximum, &part[1]);
        if (status == ICC_OK)
            status = move_root(s, maximum, &function, &part[2], err);
    }
    if (status == ICC_OK && !enough)
        status = iccp_function_is_regular(s->function, &enough, &part[3]);
    if (status != ICC_OK || enough)
        return status;
    function.constraints = ICC_CONSTRAINTS_ALL;
    return move_root(s, s->chosen, &function, &part[4], err);
}

/* Section 5.2: makes the function on the tree with the given options; plates are a special case. */
static icc_status make_function(stages *s, const iccp_env *env, icc_error *err)
{
    const double start = iccp_seconds(), grown = s->timings->tree;
    const icc_chart_options *options = s->options;
    const icc_function_options function = {.function = options->function,
                                           .constraints = options->constraints,
                                           .solver = options->solver,
                                           .min_fall = options->min_fall,
                                           .leaf_min = options->leaf_min};
    const bool is_plate =
        options->function == ICC_FUNCTION_BILAPLACE || options->function == ICC_FUNCTION_CLAMPED;
    const icc_status status =
        is_plate && options->constraints != ICC_CONSTRAINTS_ALL
            ? make_plate(s, &function, env, err)
            : iccp_function_create(&s->function, s->tree, &function, env, err);
    s->timings->function += iccp_seconds() - start - (s->timings->tree - grown);
    return status;
}

icc_status iccp_gradient_stages(icc_function **out, uint32_t *chosen, icc_chart_timings *timings,
                                const icc_domain *domain, const icc_chart_options *options,
                                const iccp_env *env, icc_error *err)
{
    stages s = {.options = options, .timings = timings};
    iccp_env part[2];
    iccp_split(part, 2, (const double[]){1, 1}, env);
    icc_status status = make_tree(&s, domain, &part[0], err);
    if (status == ICC_OK)
        status = make_function(&s, &part[1], err);
    iccp_tree_release(s.tree);
    if (status != ICC_OK) {
        iccp_function_release(s.function);
        s.function = NULL;
    }
    *out = s.function;
    *chosen = s.chosen;
    return status;
}
