/* Makes a tree and an order of its vertices, if necessary on a restricted grid. */
#include "gradient/tree/create_ranked.h"

#include "gradient/tree/grow.h"

enum { MOST_ROUNDS = 8 }; /* two were enough for all surfaces tried */

/* Makes a copy of the grid in which only vertices with a rank are inside. */
static icc_status keep_ranked(icc_grid **out, const icc_grid *grid, const uint32_t *rank,
                              const iccp_env *env, icc_error *err)
{
    *out = NULL;
    uint8_t *keep = iccp_alloc(&env->memory, grid->n_vertices, sizeof *keep);
    if (keep == NULL)
        return ICC_ERR_MEMORY;
    for (size_t v = 0; v < grid->n_vertices; ++v)
        keep[v] = rank[v] != ICCP_NONE;
    const icc_status status = iccp_grid_restrict(out, grid, keep, env, err);
    iccp_free(&env->memory, keep);
    return status;
}

icc_status iccp_tree_create_ranked(icc_tree **out, const icc_grid *grid, uint32_t root,
                                   int32_t form, const int32_t *axis_order, double most_lost,
                                   uint32_t *rank, icc_grow_report *report, const iccp_env *env,
                                   icc_error *err)
{
    const double n_whole = (double)grid->n_inside;
    icc_grid *part = iccp_grid_retain(grid);
    icc_status status = ICC_ERR_TOPOLOGY;
    *out = NULL;
    for (int round = 0; round < MOST_ROUNDS && status == ICC_ERR_TOPOLOGY; ++round) {
        icc_tree *tree;
        status = iccp_tree_create(&tree, part, root, form, axis_order, env, err);
        if (status != ICC_OK)
            break;
        status = iccp_tree_grow(tree, NULL, rank, report, env, err);
        if (status == ICC_OK) {
            *out = tree;
            break;
        }
        iccp_tree_release(tree);
        const double n_placed = (double)(report->n_vertices - report->n_unplaced);
        if (status != ICC_ERR_TOPOLOGY || n_whole - n_placed > most_lost * n_whole)
            break;
        icc_grid *smaller;
        const icc_status kept = keep_ranked(&smaller, part, rank, env, err);
        iccp_grid_release(part);
        part = smaller;
        status = kept == ICC_OK ? status : kept;
    }
    iccp_grid_release(part);
    return status;
}
