/* Checks the arguments of the functions on grids. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/domain.h"
#include "gradient/grid/grassfire.h"
#include "gradient/grid/lattice.h"
#include "gradient/grid/rasterise.h"
#include "gradient/grid/refine.h"
#include "icc/stages.h"

#include <math.h>

ICCP_END(grid)

static const int32_t DEFAULT_CELLS = 50; /* from the papers */

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
        status = iccp_domain_require_ball(domain, "the domain of a grid", err);
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

icc_status icc_grid_get_points(const icc_grid *grid, size_t n, const uint32_t *vertices,
                               double *points)
{
    ICCP_ENTER;
    if (grid == NULL || (n > 0 && points == NULL) || (vertices == NULL && n > grid->n_vertices))
        return ICC_ERR_ARGUMENT;
    for (size_t i = 0; i < n && vertices != NULL; ++i)
        if (vertices[i] >= grid->n_vertices)
            return ICC_ERR_ARGUMENT;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t v = vertices != NULL ? vertices[i] : (uint32_t)i;
        double local[ICC_MAX_DIM];
        for (int32_t k = 0; k < grid->dim; ++k)
            local[k] = grid->origin[k] + grid->spacing * iccp_grid_coordinate(grid, v, k);
        iccp_frame_out(&grid->frame, grid->dim, local, points + (size_t)grid->dim * i);
    }
    return ICC_OK;
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
