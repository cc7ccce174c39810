/* Sorts points into the cells of a regular grid by counting: C. Ericson, Real-Time Collision
 * Detection, section 7.1. */
#include "kernel/sampling/cells.h"

#include "base/minmax.h"
#include "math/vec.h"

#include <math.h>

/* More cells per point would cost more than they save. */
static const double CELLS_A_POINT = 4;

static size_t cell_along(const iccp_cells *cells, size_t k, double x)
{
    const double at = (x - cells->lower[k]) / cells->side;
    const double last = (double)(cells->shape[k] - 1);
    return at >= last ? cells->shape[k] - 1 : at > 0 ? (size_t)at : 0;
}

static size_t cell_of(const iccp_cells *cells, const double *point)
{
    size_t cell = 0;
    for (size_t k = cells->dim; k-- > 0;)
        cell = cell * cells->shape[k] + cell_along(cells, k, point[k]);
    return cell;
}

/* Chooses box, side and shape. The side grows until there are not too many cells. */
static void lay_out(iccp_cells *cells, double side)
{
    double extent[3] = {0, 0, 0}, longest = 0;
    for (size_t k = 0; k < cells->dim; ++k) {
        double upper = cells->lower[k] = cells->n > 0 ? cells->points[k] : 0;
        for (size_t i = 1; i < cells->n; ++i) {
            cells->lower[k] = iccp_min(cells->lower[k], cells->points[cells->dim * i + k]);
            upper = iccp_max(upper, cells->points[cells->dim * i + k]);
        }
        extent[k] = upper - cells->lower[k];
        longest = iccp_max(longest, extent[k]);
    }
    cells->side = side > 0 ? side : longest > 0 ? longest : 1;
    for (double n_cells = HUGE_VAL;; cells->side *= 1.5) {
        n_cells = 1;
        for (size_t k = 0; k < cells->dim; ++k)
            n_cells *= floor(extent[k] / cells->side) + 1;
        if (n_cells <= CELLS_A_POINT * (double)cells->n + 1)
            break;
    }
    for (size_t k = 0; k < 3; ++k)
        cells->shape[k] = k < cells->dim ? (size_t)(extent[k] / cells->side) + 1 : 1;
}

/* Counts, adds up, and fills in backwards, which leaves each cell's points in ascending order. */
static void sort_points(iccp_cells *cells, size_t n_cells)
{
    for (size_t i = 0; i < cells->n; ++i)
        ++cells->first[cell_of(cells, cells->points + cells->dim * i)];
    for (size_t c = 0; c < n_cells; ++c)
        cells->first[c + 1] += cells->first[c];
    for (size_t i = cells->n; i-- > 0;)
        cells->order[--cells->first[cell_of(cells, cells->points + cells->dim * i)]] = (uint32_t)i;
}

icc_status iccp_cells_create(iccp_cells *cells, size_t dim, size_t n, const double *points,
                             double side, const iccp_env *env)
{
    *cells = (iccp_cells){.memory = env->memory, .dim = dim, .n = n, .points = points};
    lay_out(cells, side);
    const size_t n_cells = cells->shape[0] * cells->shape[1] * cells->shape[2];
    cells->first = iccp_alloc_zero(&env->memory, n_cells + 1, sizeof *cells->first);
    cells->order = iccp_alloc(&env->memory, n, sizeof *cells->order);
    if (cells->first == NULL || cells->order == NULL) {
        iccp_cells_free(cells);
        return ICC_ERR_MEMORY;
    }
    sort_points(cells, n_cells);
    return ICC_OK;
}

void iccp_cells_free(iccp_cells *cells)
{
    if (cells->memory.dealloc != NULL) {
        iccp_free(&cells->memory, cells->first);
        iccp_free(&cells->memory, cells->order);
    }
    *cells = (iccp_cells){0};
}

/* Widens the radius by an ulp, so that a point at the radius up to rounding is not missed. */
bool iccp_cells_box(const iccp_cells *cells, const double *place, double radius, iccp_cell_box *box)
{
    const double wide = radius * (1 + 1e-15);
    for (size_t k = 0; k < 3; ++k) {
        box->from[k] = box->to[k] = 0;
        if (k >= cells->dim)
            continue;
        const double end = cells->lower[k] + (double)cells->shape[k] * cells->side;
        if (place[k] + wide < cells->lower[k] || place[k] - wide > end)
            return false;
        box->from[k] = cell_along(cells, k, place[k] - wide);
        box->to[k] = cell_along(cells, k, place[k] + wide);
    }
    return cells->n > 0;
}

size_t iccp_cells_near(const iccp_cells *cells, const double *place, double radius, size_t capacity,
                       uint32_t *near)
{
    iccp_cell_box box;
    size_t n = 0;
    if (!iccp_cells_box(cells, place, radius, &box))
        return 0;
    for (size_t z = box.from[2]; z <= box.to[2]; ++z)
        for (size_t y = box.from[1]; y <= box.to[1]; ++y) {
            const size_t row = (z * cells->shape[1] + y) * cells->shape[0];
            const uint32_t end = cells->first[row + box.to[0] + 1];
            for (uint32_t at = cells->first[row + box.from[0]]; at < end; ++at) {
                const uint32_t i = cells->order[at];
                if (iccp_vec_distance2(cells->dim, place, cells->points + cells->dim * i) >
                    radius * radius)
                    continue;
                if (n < capacity)
                    near[n] = i;
                ++n;
            }
        }
    return n;
}
