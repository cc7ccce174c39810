/* What gradient lines need: the tree, the function, and the boundary where they end. */
#include "gradient/coordinates/gradient_state.h"

icc_status iccp_gradient_meet_boundary(iccp_gradient_state *state, const iccp_env *env)
{
    const icc_grid *grid = state->tree->grid;
    return grid->dim == 2 ? iccp_boundary_cells2_create(&state->cells2, grid->domain, grid, env)
                          : iccp_boundary_cellsn_create(&state->cellsn, grid->domain, grid, env);
}

void iccp_gradient_state_clear(iccp_gradient_state *state)
{
    if (state->cells2.vertices != NULL)
        iccp_boundary_cells2_free(&state->cells2);
    if (state->cellsn.domain != NULL)
        iccp_boundary_cellsn_free(&state->cellsn);
    iccp_function_release(state->field);
    iccp_tree_release(state->tree);
}
