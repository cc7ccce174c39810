/* Makes grids of half the spacing. Based on: H. Edelsbrunner and D. R. Grayson, Edgewise
 * Subdivision of a Simplex, Discrete & Computational Geometry 24, 2000. The subdivision of a Kuhn
 * triangulation is the Kuhn triangulation of the lattice of half the spacing. The new vertices are
 * the middles of its edges. */
#include "gradient/grid/refine.h"

/* Finds the ends of the edge whose middle a vertex of the finer grid is. Both are the same if the
 * vertex is old. */
static void find_ends(const icc_grid *coarse, const icc_grid *fine, uint32_t vertex, size_t *lower,
                      size_t *upper)
{
    *lower = *upper = 0;
    for (int32_t k = 0; k < fine->dim; ++k) {
        const uint32_t at = iccp_grid_coordinate(fine, vertex, k);
        *lower += coarse->stride[k] * (at / 2);
        *upper += coarse->stride[k] * ((at + 1) / 2);
    }
}

icc_status iccp_grid_refine(icc_grid **out, const icc_grid *grid, const iccp_env *env,
                            icc_error *err)
{
    *out = NULL;
    size_t shape[ICC_MAX_DIM];
    for (int32_t k = 0; k < grid->dim; ++k)
        shape[k] = 2 * grid->shape[k] - 1;
    icc_grid *fine;
    const icc_status status = iccp_grid_new(&fine, grid->dim, shape, env, err);
    if (status != ICC_OK)
        return status;
    fine->frame = grid->frame;
    fine->spacing = 0.5 * grid->spacing;
    fine->cells = 2 * grid->cells;
    fine->n_stray = grid->n_stray;
    for (int32_t k = 0; k < grid->dim; ++k)
        fine->origin[k] = grid->origin[k];
    for (size_t v = 0; v < fine->n_vertices; ++v) {
        if (v % ICCP_VERTICES_PER_REPORT == 0 &&
            iccp_progress(env, "grid", (double)v / (double)fine->n_vertices) != ICC_OK) {
            iccp_grid_release(fine);
            return ICC_ERR_CANCELLED;
        }
        size_t lower, upper;
        find_ends(grid, fine, (uint32_t)v, &lower, &upper);
        fine->inside[v] = grid->inside[lower] && grid->inside[upper];
        fine->n_inside += fine->inside[v];
    }
    *out = fine;
    return ICC_OK;
}
