/* One simplex of the Kuhn triangulation, and the way across its facets: a cell and the order of the axes in
 * which its diagonal is gone along. Any dimension. */
#ifndef ICCP_KUHN_SIMPLEX_H
#define ICCP_KUHN_SIMPLEX_H

#include "grid/lattice.h"

#include <stdbool.h>

typedef struct iccp_kuhn_simplex {
    uint32_t corner[ICC_MAX_DIM + 1]; /* from the lowest to the highest: grid vertices */
    int8_t axis[ICC_MAX_DIM];         /* corner k + 1 lies one step along axis[k] from corner k */
} iccp_kuhn_simplex;

/* The simplex that holds a point in lattice coordinates, and the point's barycentric coordinates (dim + 1,
 * not negative, sum 1 up to rounding; equal local coordinates in the order of the axes). False when the
 * point is not within the grid. */
bool iccp_kuhn_simplex_at(iccp_kuhn_simplex *simplex, const icc_grid *grid, const double *x,
                          double *lambda);

/* Goes to the simplex across the facet opposite to corner i. The corners that stay keep their order; the new
 * one becomes corner number *fresh (i, dim or 0), and going across the facet opposite to it leads back.
 * False, and nothing changed, at the border of the grid. */
bool iccp_kuhn_simplex_cross(iccp_kuhn_simplex *simplex, const icc_grid *grid, int32_t i,
                             int32_t *fresh);

/* Moves barycentric coordinates along: those of the corners that stay, 0 for the new one. */
void iccp_kuhn_simplex_carry(int32_t dim, int32_t i, double *lambda);

/* The lattice coordinates of a point. */
void iccp_kuhn_simplex_point(const iccp_kuhn_simplex *simplex, const icc_grid *grid,
                             const double *lambda, double *x);

#endif
