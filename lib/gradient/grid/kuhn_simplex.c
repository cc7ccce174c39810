/* Simplices of the Kuhn triangulation. Based on: H. Freudenthal, Simplizialzerlegungen von
 * beschraenkter Flachheit, Annals of Mathematics 43, 1942; pivoting as in M. Todd, The Computation
 * of Fixed Points and Applications, 1976, chapter III. */
#include "gradient/grid/kuhn_simplex.h"

#include "base/minmax.h"

#include <math.h>
#include <string.h>

/* Sorts axes by descending local coordinate. Insertion sort keeps equal ones in the order of the
 * axes. */
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
        const double cell = iccp_min(floor(x[k]), last - 1);
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

bool iccp_kuhn_simplex_cross(iccp_kuhn_simplex *simplex, const icc_grid *grid, int32_t i,
                             int32_t *fresh)
{
    return iccp_kuhn_simplex_cross_in(simplex, grid->dim, grid, i, fresh);
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
