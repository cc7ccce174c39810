/* Neighbours of a grid vertex in the Kuhn triangulation. */
#include "gradient/grid/star.h"

void iccp_star_init(iccp_star *star, const icc_grid *grid, size_t n_asked)
{
    star->grid = grid;
    iccp_kuhn_init(&star->kuhn, grid->dim);
    if (grid->dim <= 3 && n_asked >> star->kuhn.n_neighbours > 0)
        iccp_kuhn_tabulate(&star->kuhn);
    for (int i = 0; i < star->kuhn.n_neighbours; ++i) {
        star->offset[i] = 0;
        for (int32_t k = 0; k < grid->dim; ++k)
            star->offset[i] += star->kuhn.step[i][k] * (ptrdiff_t)grid->stride[k];
    }
}

bool iccp_star_is_cut(const iccp_star *star, uint32_t v)
{
    for (int32_t k = 0; k < star->grid->dim; ++k) {
        const uint32_t at = iccp_grid_coordinate(star->grid, v, k);
        if (at == 0 || at + 1 == star->grid->shape[k])
            return true;
    }
    return false;
}

iccp_link_set iccp_star_within(const iccp_star *star, uint32_t v)
{
    iccp_link_set within = {{0, 0}};
    for (int i = 0; i < star->kuhn.n_neighbours; ++i) {
        bool in_grid = true;
        for (int32_t k = 0; k < star->grid->dim; ++k) {
            const int step = star->kuhn.step[i][k];
            in_grid =
                in_grid && (step == 0 || iccp_grid_neighbour(star->grid, v, k, step) != ICCP_NONE);
        }
        if (in_grid)
            iccp_link_add(&within, i);
    }
    return within;
}
