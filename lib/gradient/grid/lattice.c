/* The grid object. */
#include "gradient/grid/lattice.h"

#include "base/budget.h"
#include "base/error.h"
#include "base/minmax.h"

#include <assert.h>
#include <math.h>

static size_t count_vertices(int32_t dim, const size_t *shape)
{
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k) {
        assert(shape[k] > 0);
        if (shape[k] > ICCP_MAX_VERTICES / n)
            return SIZE_MAX;
        n *= shape[k];
    }
    return n;
}

/* Bytes per vertex of a chart's tree, function and other arrays while they are made, except factors
 * of matrices. Measurements gave 29 to 180, including the matrices. */
static const double BYTES_PER_VERTEX = 300;

/* Work of scanning a domain, growing a tree and verifying a function, in simplices per vertex. */
static double work_per_vertex(int32_t dim)
{
    return 200 + 2 * iccp_simplices_at_vertex(dim);
}

icc_status iccp_grid_new(icc_grid **out, int32_t dim, const size_t *shape, const iccp_env *env,
                         icc_error *err)
{
    assert(dim >= 1 && dim <= ICC_MAX_DIM);
    *out = NULL;
    const size_t n = count_vertices(dim, shape);
    if (n > ICCP_MAX_VERTICES)
        return iccp_fail(err, ICC_ERR_RESOLUTION, "the grid would have more than %zu vertices",
                         ICCP_MAX_VERTICES);
    icc_status status = iccp_budget_keep(env, (double)n * BYTES_PER_VERTEX);
    if (status == ICC_OK)
        status = iccp_budget_work(env, (double)n * work_per_vertex(dim));
    if (status != ICC_OK)
        return iccp_explain(err, status);
    icc_grid *grid = iccp_alloc_zero(&env->memory, 1, sizeof *grid);
    if (grid == NULL)
        return iccp_fail_memory(err);
    grid->memory = env->memory;
    atomic_init(&grid->references, 1);
    grid->dim = dim;
    grid->n_vertices = 1;
    for (int32_t k = 0; k < dim; ++k) {
        grid->shape[k] = shape[k];
        grid->stride[k] = grid->n_vertices;
        grid->n_vertices *= shape[k];
    }
    grid->spacing = 1.0;
    grid->frame = iccp_frame_identity();
    grid->inside = iccp_alloc_zero(&env->memory, n, sizeof *grid->inside);
    if (grid->inside == NULL) {
        iccp_grid_release(grid);
        return iccp_fail_memory(err);
    }
    *out = grid;
    return ICC_OK;
}

icc_status iccp_grid_create_mask(icc_grid **out, int32_t dim, const size_t *shape,
                                 const uint8_t *inside, const iccp_env *env, icc_error *err)
{
    const icc_status status = iccp_grid_new(out, dim, shape, env, err);
    if (status != ICC_OK)
        return status;
    icc_grid *grid = *out;
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        grid->inside[v] = inside[v] != 0;
        grid->n_inside += grid->inside[v];
    }
    return ICC_OK;
}

icc_status iccp_grid_restrict(icc_grid **out, const icc_grid *grid, const uint8_t *keep,
                              const iccp_env *env, icc_error *err)
{
    const icc_status status = iccp_grid_new(out, grid->dim, grid->shape, env, err);
    if (status != ICC_OK)
        return status;
    icc_grid *part = *out;
    part->frame = grid->frame;
    part->spacing = grid->spacing;
    part->cells = grid->cells;
    part->domain = grid->domain != NULL ? iccp_domain_retain(grid->domain) : NULL;
    part->is_restricted = true;
    for (int32_t k = 0; k < grid->dim; ++k)
        part->origin[k] = grid->origin[k];
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        if (v % ICCP_VERTICES_PER_REPORT == 0 &&
            iccp_progress(env, "grid", (double)v / (double)grid->n_vertices) != ICC_OK) {
            iccp_grid_release(part);
            *out = NULL;
            return ICC_ERR_CANCELLED;
        }
        part->inside[v] = grid->inside[v] && keep[v] != 0;
        part->n_inside += part->inside[v];
    }
    part->n_stray = grid->n_stray + grid->n_inside - part->n_inside;
    return ICC_OK;
}

icc_grid *iccp_grid_retain(const icc_grid *grid)
{
    icc_grid *shared = (icc_grid *)grid;
    atomic_fetch_add_explicit(&shared->references, 1, memory_order_relaxed);
    return shared;
}

void iccp_grid_release(icc_grid *grid)
{
    if (grid == NULL || atomic_fetch_sub(&grid->references, 1) != 1)
        return;
    const iccp_memory memory = grid->memory;
    iccp_domain_release(grid->domain);
    iccp_free(&memory, grid->inside);
    iccp_free(&memory, grid);
}

uint32_t iccp_grid_nearest(const icc_grid *grid, const double *point)
{
    /* In units of cells. A point so far away that squares would overflow is moved closer. */
    double at[ICC_MAX_DIM];
    for (int32_t k = 0; k < grid->dim; ++k)
        at[k] = iccp_max(-1e150, iccp_min(1e150, (point[k] - grid->origin[k]) / grid->spacing));
    uint32_t nearest = ICCP_NONE;
    double least = HUGE_VAL;
    for (uint32_t v = 0; v < grid->n_vertices; ++v) {
        if (!grid->inside[v])
            continue;
        double square = 0.0;
        for (int32_t k = 0; k < grid->dim; ++k) {
            const double step = iccp_grid_coordinate(grid, v, k) - at[k];
            square += step * step;
        }
        if (square < least) {
            least = square;
            nearest = v;
        }
    }
    return nearest;
}
