/* Based on: H. Freudenthal, Simplizialzerlegungen von beschraenkter Flachheit, Annals of Mathematics 43,
 * 1942; pivoting as in M. Todd, The Computation of Fixed Points and Applications, 1976, chapter III. */
#include "grid/kuhn_simplex.h"

#include <math.h>
#include <string.h>

/* By descending local coordinate; insertion keeps equal ones in the order of the axes. */
static void sort_axes(int32_t dim, const double *u, int8_t *axis)
{
    for (int32_t k = 0; k < dim; ++k) {
        int32_t i = k;
        for (; i > 0 && u[axis[i - 1]] < u[k]; --i)
            axis[i] = axis[i - 1];
        axis[i] = (int8_t)k;
    }
}

bool iccp_kuhn_simplex_at(iccp_kuhn_simplex *simplex, const icc_grid *grid, const double *x,
                          double *lambda)
{
    const int32_t dim = grid->dim;
    double u[ICC_MAX_DIM];
    size_t lowest = 0;
    for (int32_t k = 0; k < dim; ++k) {
        const double last = (double)(grid->shape[k] - 1);
        if (!(x[k] >= 0 && x[k] <= last) || grid->shape[k] < 2)
            return false;
        const double cell = fmin(floor(x[k]), last - 1);
        u[k] = x[k] - cell;
        lowest += (size_t)cell * grid->stride[k];
    }
    sort_axes(dim, u, simplex->axis);
    simplex->corner[0] = (uint32_t)lowest;
    double above = 1;
    for (int32_t k = 0; k < dim; ++k) {
        const int8_t axis = simplex->axis[k];
        simplex->corner[k + 1] = simplex->corner[k] + (uint32_t)grid->stride[axis];
        lambda[k] = above - u[axis];
        above = u[axis];
    }
    lambda[dim] = above;
    return true;
}

/* The facet opposite to the lowest corner: on to the cell in which the old highest corner goes on. */
static bool cross_up(iccp_kuhn_simplex *s, const icc_grid *grid)
{
    const int32_t dim = grid->dim;
    const int8_t axis = s->axis[0];
    const uint32_t corner = iccp_grid_neighbour(grid, s->corner[dim], axis, +1);
    if (corner == ICCP_NONE)
        return false;
    memmove(s->corner, s->corner + 1, (size_t)dim * sizeof *s->corner);
    memmove(s->axis, s->axis + 1, (size_t)(dim - 1) * sizeof *s->axis);
    s->corner[dim] = corner;
    s->axis[dim - 1] = axis;
    return true;
}

static bool cross_down(iccp_kuhn_simplex *s, const icc_grid *grid)
{
    const int32_t dim = grid->dim;
    const int8_t axis = s->axis[dim - 1];
    const uint32_t corner = iccp_grid_neighbour(grid, s->corner[0], axis, -1);
    if (corner == ICCP_NONE)
        return false;
    memmove(s->corner + 1, s->corner, (size_t)dim * sizeof *s->corner);
    memmove(s->axis + 1, s->axis, (size_t)(dim - 1) * sizeof *s->axis);
    s->corner[0] = corner;
    s->axis[0] = axis;
    return true;
}

bool iccp_kuhn_simplex_cross(iccp_kuhn_simplex *simplex, const icc_grid *grid, int32_t i,
                             int32_t *fresh)
{
    const int32_t dim = grid->dim;
    *fresh = i == 0 ? dim : i == dim ? 0 : i;
    if (i == 0)
        return cross_up(simplex, grid);
    if (i == dim)
        return cross_down(simplex, grid);
    const int8_t axis = simplex->axis[i];
    simplex->axis[i] = simplex->axis[i - 1];
    simplex->axis[i - 1] = axis;
    simplex->corner[i] = simplex->corner[i - 1] + (uint32_t)grid->stride[axis];
    return true;
}

void iccp_kuhn_simplex_carry(int32_t dim, int32_t i, double *lambda)
{
    if (i == 0)
        memmove(lambda, lambda + 1, (size_t)dim * sizeof *lambda);
    else if (i == dim)
        memmove(lambda + 1, lambda, (size_t)dim * sizeof *lambda);
    lambda[i == 0 ? dim : i == dim ? 0 : i] = 0;
}

void iccp_kuhn_simplex_point(const iccp_kuhn_simplex *simplex, const icc_grid *grid,
                             const double *lambda, double *x)
{
    double beyond = 0;
    for (int32_t k = grid->dim; k-- > 0;) {
        const int8_t axis = simplex->axis[k];
        beyond += lambda[k + 1];
        x[axis] = iccp_grid_coordinate(grid, simplex->corner[0], axis) + beyond;
    }
}
