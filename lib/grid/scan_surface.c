#include "grid/scan_surface.h"

#include "base/threads.h"

static const size_t GRAIN = 1 << 12; /* vertices per chunk */

typedef struct work {
    icc_grid *grid;
    const icc_domain *domain;
} work;

static icc_status locate_chunk(void *argument, size_t begin, size_t end)
{
    const work *w = argument;
    icc_grid *grid = w->grid;
    for (uint32_t v = (uint32_t)begin; v < end; ++v) {
        double p[ICC_MAX_DIM];
        for (int32_t k = 0; k < grid->dim; ++k)
            p[k] = grid->origin[k] + grid->spacing * iccp_grid_coordinate(grid, v, k);
        grid->inside[v] = iccp_domain_locate(w->domain, p, false, NULL, NULL) == ICC_INSIDE;
    }
    return ICC_OK;
}

icc_status iccp_scan_surface(icc_grid *grid, const icc_domain *domain, const iccp_env *env)
{
    work w = {grid, domain};
    const icc_status status =
        iccp_for_chunks(env, "grid", grid->n_vertices, GRAIN, locate_chunk, &w);
    if (status == ICC_OK)
        for (size_t v = 0; v < grid->n_vertices; ++v)
            grid->n_inside += grid->inside[v];
    return status;
}
