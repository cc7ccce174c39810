/* Makes a grid from a domain. */
#include "gradient/grid/rasterise.h"

#include "base/error.h"
#include "base/minmax.h"
#include "domain/mask.h"
#include "gradient/grid/pieces.h"

#include <math.h>
#include <string.h>

enum { MARGIN = 2 }; /* layers of vertices beyond the bounding box */

/* Returns how many vertices fit into a side of the bounding box. Unless there is only one, they
 * stay at least a quarter of a cell away from its ends. */
static size_t vertices_within(double side, double spacing)
{
    const double n = floor(side / spacing + 0.5);
    return n > 1.0 ? (size_t)n : 1;
}

/* Makes a grid over the bounding box with no vertex inside. */
static icc_status cover_box(icc_grid **out, const icc_domain *domain, int32_t cells,
                            const iccp_env *env, icc_error *err)
{
    double side[ICC_MAX_DIM], longest = 0;
    for (int32_t k = 0; k < domain->dim; ++k) {
        side[k] = domain->upper[k] - domain->lower[k];
        longest = iccp_max(longest, side[k]);
    }
    const double spacing = longest / cells;
    size_t shape[ICC_MAX_DIM];
    for (int32_t k = 0; k < domain->dim; ++k)
        shape[k] = vertices_within(side[k], spacing) + 2 * MARGIN;
    const icc_status status = iccp_grid_new(out, domain->dim, shape, env, err);
    if (status != ICC_OK)
        return status;
    icc_grid *grid = *out;
    grid->cells = cells;
    grid->spacing = spacing;
    for (int32_t k = 0; k < domain->dim; ++k)
        grid->origin[k] = domain->lower[k] + 0.5 * side[k] - 0.5 * spacing * (double)(shape[k] - 1);
    return ICC_OK;
}

static icc_status create_in_boundary(icc_grid **out, const icc_domain *domain, int32_t cells,
                                     const iccp_env *env, icc_error *err)
{
    icc_status status = cover_box(out, domain, cells, env, err);
    if (status != ICC_OK)
        return status;
    icc_grid *grid = *out;
    iccp_raster raster = {.spacing = grid->spacing};
    memcpy(raster.shape, grid->shape, sizeof raster.shape);
    memcpy(raster.origin, grid->origin, sizeof raster.origin);
    status = iccp_domain_scan(domain, &raster, grid->inside, &grid->n_inside, env);
    return status == ICC_OK && domain->dim != 2 ? iccp_grid_keep_largest(grid, env) : status;
}

/* ---- masks ---- */

/* Returns the vertex of the cut lattice that a position belongs to: a wall, or the middle of a
 * cell. */
static size_t halves(size_t position, size_t cuts)
{
    return 2 * (position / cuts) + (position % cuts != 0);
}

/* Scans the vertices along the first axis that lie in the mask or on its border. */
static void scan_row(icc_grid *grid, const iccp_mask *mask, size_t cuts, size_t first, size_t *at)
{
    for (size_t i = 0; i <= cuts * mask->shape[0]; ++i) {
        int n_axes;
        at[0] = halves(i, cuts);
        const bool within = iccp_mask_block(mask, at, &n_axes) == iccp_mask_full(n_axes);
        grid->inside[first + i] = within;
        grid->n_inside += within;
    }
}

/* Finds the vertices of a grid that lie inside a mask: all cells around them do. The grid has
 * `cuts` vertices per cell along each axis, including the walls between cells, and `margin` layers
 * beyond the mask. */
static icc_status scan_mask(icc_grid *grid, const iccp_mask *mask, size_t cuts, size_t margin,
                            const iccp_env *env)
{
    const size_t row = cuts * mask->shape[0] + 1, n_rows = grid->n_vertices / grid->shape[0];
    const size_t rows_per_report = 1 + ICCP_VERTICES_PER_REPORT / row;
    size_t position[ICC_MAX_DIM] = {0}, at[ICC_MAX_DIM];
    for (size_t n_done = 0;; ++n_done) {
        if (n_done % rows_per_report == 0 &&
            iccp_progress(env, "grid", (double)n_done / (double)n_rows) != ICC_OK)
            return ICC_ERR_CANCELLED;
        size_t first = margin;
        for (int32_t k = 1; k < grid->dim; ++k) {
            first += (position[k] + margin) * grid->stride[k];
            at[k] = halves(position[k], cuts);
        }
        scan_row(grid, mask, cuts, first, at);
        int32_t k = 1;
        while (k < grid->dim && ++position[k] > cuts * mask->shape[k])
            position[k++] = 0;
        if (k >= grid->dim)
            return ICC_OK;
    }
}

/* Returns the number of vertices per cell of the mask: the least even number that gives `cells`
 * along the longest side. */
static size_t cuts_for(const iccp_mask *mask, int32_t cells)
{
    size_t longest = 0;
    for (int32_t k = 0; k < mask->dim; ++k)
        longest = mask->shape[k] > longest ? mask->shape[k] : longest;
    const size_t half = ((size_t)cells + 2 * longest - 1) / (2 * longest);
    return half > 1 ? 2 * half : 2;
}

/* Every cuts-th vertex along an axis is a corner of the mask's cells. So the boundary follows edges
 * of the grid and cuts no grid cell. The first vertex lies MARGIN layers before the mask's
 * corner. */
static icc_status create_in_mask(icc_grid **out, const icc_domain *domain, int32_t cells,
                                 const iccp_env *env, icc_error *err)
{
    const iccp_mask *mask = domain->mask;
    const size_t cuts = cuts_for(mask, cells);
    const double border = -(double)MARGIN / (double)cuts;
    double first[ICC_MAX_DIM];
    size_t shape[ICC_MAX_DIM], longest = 0;
    for (int32_t k = 0; k < mask->dim; ++k) {
        shape[k] = cuts * mask->shape[k] + 1 + 2 * MARGIN;
        longest = mask->shape[k] > longest ? mask->shape[k] : longest;
        first[k] = border;
    }
    const icc_status status = iccp_grid_new(out, mask->dim, shape, env, err);
    if (status != ICC_OK)
        return status;
    icc_grid *grid = *out;
    grid->cells = (int32_t)(cuts * longest);
    grid->spacing = 1.0 / (double)cuts * domain->frame.in[0] * domain->frame.in[1];
    iccp_frame_in(&domain->frame, mask->dim, first, grid->origin);
    return scan_mask(grid, mask, cuts, MARGIN, env);
}

/* ---- any domain ---- */

icc_status iccp_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                            const iccp_env *env, icc_error *err)
{
    *out = NULL;
    icc_status status = domain->mask != NULL ? create_in_mask(out, domain, cells, env, err)
                                             : create_in_boundary(out, domain, cells, env, err);
    if (status == ICC_OK && (*out)->n_inside == 0)
        status = iccp_fail(err, ICC_ERR_RESOLUTION,
                           "no grid vertex lies inside: use more than %d cells", (int)cells);
    if (status == ICC_OK) {
        (*out)->frame = domain->frame;
        (*out)->domain = iccp_domain_retain(domain);
    } else {
        iccp_grid_release(*out);
        *out = NULL;
    }
    return status;
}
