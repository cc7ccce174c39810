/* One simplex of the Kuhn triangulation, and how to cross its facets. A simplex is a cell and an
 * order of the axes: the steps from the cell's lowest corner to its highest. Any dimension. */
#ifndef ICCP_KUHN_SIMPLEX_H
#define ICCP_KUHN_SIMPLEX_H

#include "gradient/grid/lattice.h"

#include "base/compiler.h"
#include "math/predicates.h"

#include <stdbool.h>
#include <string.h>

typedef struct iccp_kuhn_simplex {
    uint32_t corner[ICC_MAX_DIM + 1]; /* grid vertices, from the lowest to the highest */
    int8_t axis[ICC_MAX_DIM];         /* corner k + 1 lies one step along axis[k] from corner k */
} iccp_kuhn_simplex;

/* Finds the simplex that contains a point in lattice coordinates, and the point's dim + 1
 * barycentric coordinates. They are not negative and have sum 1 up to rounding. Equal local
 * coordinates keep the order of the axes. Returns false if the point is not within the grid. */
bool iccp_kuhn_simplex_at(iccp_kuhn_simplex *simplex, const icc_grid *grid, const double *x,
                          double *lambda);

/* Goes to the simplex across the facet opposite corner i. The remaining corners keep their order.
 * The new one becomes corner number *fresh (i, dim or 0); crossing the facet opposite it leads
 * back. Returns false and changes nothing at the border of the grid. */
bool iccp_kuhn_simplex_cross(iccp_kuhn_simplex *simplex, const icc_grid *grid, int32_t i,
                             int32_t *fresh);

/* Crosses the facet opposite the lowest corner, into the cell beyond the old highest corner. */
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

/* iccp_kuhn_simplex_cross() with the dimension as an argument, so that it may be constant. */
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

/* Returns the exact sign of the speed at which the gradient of a simplex leads away from the facet
 * opposite one of its corners. Takes the values at the corners before, at, and after it in the
 * order of the simplex. At an end of that order, the missing one is that of the corner itself. */
static inline int iccp_kuhn_leads_away(double before, double at, double after)
{
    return iccp_cross_sign(at, before, 1, 0, after, at, 1, 0);
}

/* Updates barycentric coordinates for a crossing: the remaining corners keep theirs, and the new
 * one gets 0. */
void iccp_kuhn_simplex_carry(int32_t dim, int32_t i, double *lambda);

/* Computes the lattice coordinates of a point. */
void iccp_kuhn_simplex_point(const iccp_kuhn_simplex *simplex, const icc_grid *grid,
                             const double *lambda, double *x);

#endif
