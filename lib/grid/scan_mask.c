#include "grid/scan_mask.h"

/* The vertex of the lattice of halves in whose place a position counts: a wall, or the middle of a
 * cell. */
static size_t halves(size_t position, size_t cuts)
{
    return 2 * (position / cuts) + (position % cuts != 0);
}

/* The vertices along the first axis that lie in the mask or on its border. */
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

icc_status iccp_scan_mask(icc_grid *grid, const iccp_mask *mask, size_t cuts, size_t margin,
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
