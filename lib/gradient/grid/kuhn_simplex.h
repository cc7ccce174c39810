/* One simplex of the Kuhn triangulation, and the way across its facets: a cell and the order of the
 * axes in which its diagonal is gone along. Any dimension. */
#ifndef ICCP_KUHN_SIMPLEX_H
#define ICCP_KUHN_SIMPLEX_H

#include "gradient/grid/lattice.h"

#include "base/compiler.h"

#include <stdbool.h>
#include <string.h>

typedef struct iccp_kuhn_simplex {
    uint32_t corner[ICC_MAX_DIM + 1]; /* from the lowest to the highest: grid vertices */
    int8_t axis[ICC_MAX_DIM];         /* corner k + 1 lies one step along axis[k] from corner k */
} iccp_kuhn_simplex;

/* The simplex that holds a point in lattice coordinates, and the point's barycentric coordinates
 * (dim + 1, not negative, sum 1 up to rounding; equal local coordinates in the order of the axes).
 * False when the point is not within the grid. */
bool iccp_kuhn_simplex_at(iccp_kuhn_simplex *simplex, const icc_grid *grid, const double *x,
                          double *lambda);

/* Goes to the simplex across the facet opposite to corner i. The corners that stay keep their
 * order; the new one becomes corner number *fresh (i, dim or 0), and going across the facet
 * opposite to it leads back. False, and nothing changed, at the border of the grid. */
bool iccp_kuhn_simplex_cross(iccp_kuhn_simplex *simplex, const icc_grid *grid, int32_t i,
                             int32_t *fresh);

/* The facet opposite to the lowest corner: on to the cell in which the old highest corner goes
 * on. */
static ICCP_INLINE bool iccp_kuhn_simplex_up(iccp_kuhn_simplex *s, int32_t dim,
                                             const icc_grid *grid)
{
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

static ICCP_INLINE bool iccp_kuhn_simplex_down(iccp_kuhn_simplex *s, int32_t dim,
                                               const icc_grid *grid)
{
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

/* The same with the dimension, so that it may be constant. */
static ICCP_INLINE bool iccp_kuhn_simplex_cross_in(iccp_kuhn_simplex *simplex, int32_t dim,
                                                   const icc_grid *grid, int32_t i, int32_t *fresh)
{
    *fresh = i == 0 ? dim : i == dim ? 0 : i;
    if (i == 0)
        return iccp_kuhn_simplex_up(simplex, dim, grid);
    if (i == dim)
        return iccp_kuhn_simplex_down(simplex, dim, grid);
    const int8_t axis = simplex->axis[i];
    simplex->axis[i] = simplex->axis[i - 1];
    simplex->axis[i - 1] = axis;
    simplex->corner[i] = simplex->corner[i - 1] + (uint32_t)grid->stride[axis];
    return true;
}

/* Moves barycentric coordinates along: those of the corners that stay, 0 for the new one. */
void iccp_kuhn_simplex_carry(int32_t dim, int32_t i, double *lambda);

/* The lattice coordinates of a point. */
void iccp_kuhn_simplex_point(const iccp_kuhn_simplex *simplex, const icc_grid *grid,
                             const double *lambda, double *x);

#endif
