#include "solver/rows.h"

#include <string.h>

static void find_neighbours(iccp_rows *rows, const uint32_t *row_of, uint32_t k)
{
    const icc_grid *grid = rows->tree->grid;
    uint32_t *neighbour = rows->neighbour + (size_t)k * (size_t)rows->n_neighbours;
    for (int32_t axis = 0; axis < grid->dim; ++axis)
        for (int32_t side = 0; side < 2; ++side) {
            const uint32_t u = iccp_grid_neighbour(grid, rows->vertex[k], axis, 2 * side - 1);
            *neighbour++ = u == ICCP_NONE ? ICCP_NONE : row_of[u];
        }
    const uint32_t parent = rows->tree->parent[rows->vertex[k]];
    rows->parent[k] = parent == ICCP_NONE ? ICCP_NONE : row_of[parent];
}

icc_status iccp_rows_create(iccp_rows *rows, const icc_tree *tree, const iccp_env *env)
{
    const size_t n = tree->n_inside;
    *rows = (iccp_rows){.memory = env->memory,
                        .tree = tree,
                        .n = n,
                        .n_neighbours = 2 * tree->grid->dim,
                        .vertex = tree->order};
    uint32_t *row_of = iccp_alloc(&env->memory, tree->grid->n_vertices, sizeof *row_of);
    rows->parent = iccp_alloc(&env->memory, n, sizeof *rows->parent);
    rows->neighbour =
        iccp_alloc(&env->memory, n, (size_t)rows->n_neighbours * sizeof *rows->neighbour);
    icc_status status = ICC_ERR_MEMORY;
    if (row_of != NULL && rows->parent != NULL && rows->neighbour != NULL) {
        memset(row_of, 0xff, tree->grid->n_vertices * sizeof *row_of); /* ICCP_NONE */
        for (uint32_t k = 0; k < n; ++k)
            row_of[rows->vertex[k]] = k;
        status = ICC_OK;
    }
    for (uint32_t k = 0; k < n && status == ICC_OK; ++k) {
        if (k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)k / (double)n);
        find_neighbours(rows, row_of, k);
    }
    iccp_free(&env->memory, row_of);
    if (status != ICC_OK)
        iccp_rows_free(rows);
    return status;
}

void iccp_rows_free(iccp_rows *rows)
{
    iccp_free(&rows->memory, rows->parent);
    iccp_free(&rows->memory, rows->neighbour);
    rows->parent = rows->neighbour = NULL;
}
