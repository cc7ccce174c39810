/* The Bernstein coefficients of a cell's Jacobian determinant, with bounds of their rounding
 * errors.
 *
 * Based on: A. Johnen, J.-F. Remacle, C. Geuzaine, Geometrical validity of curvilinear finite
 * elements, Journal of Computational Physics 233, 2013.
 *
 * The derivative along an axis is the mean of the edges along it, weighted multilinearly by the
 * other variables. So a coefficient is a mean of determinants of three edges, one along each
 * axis. */
#ifndef ICCP_CELL_H
#define ICCP_CELL_H

#include "sampled/samples.h"

#include <stdbool.h>

enum { ICCP_CELL_EDGES = 4, ICCP_CELL_TERMS = 3, ICCP_CELL_MOST = 27 };

typedef struct iccp_cell {
    size_t n_edges[3];   /* along each axis */
    size_t degree;       /* of the determinant in each variable: 1 in 2-D, else 2 */
    size_t n, n_corners; /* coefficients; corners */
    int sign;            /* of the grid's own determinant, by which all others are multiplied */
    double term[3][ICCP_CELL_EDGES][3][ICCP_CELL_TERMS]; /* axis, edge, component */
} iccp_cell;

/* Lower and upper bounds of the coefficients, the first variable fastest. */
typedef struct iccp_cell_bounds {
    double lower[ICCP_CELL_MOST], upper[ICCP_CELL_MOST];
} iccp_cell_bounds;

/* The coefficient to which the determinant of edges a, b, c along the three axes belongs. */
static inline size_t iccp_cell_coefficient(const iccp_cell *cell, size_t a, size_t b, size_t c)
{
    if (cell->degree == 1)
        return b + 2 * a;
    return (b & 1) + (c & 1) + 3 * ((a & 1) + (c >> 1)) + 9 * ((a >> 1) + (b >> 1));
}

/* The coefficient that is the value at a corner. */
static inline size_t iccp_cell_corner(const iccp_cell *cell, size_t corner)
{
    const size_t d = cell->degree, row = d + 1;
    return d * ((corner & 1) + row * (corner >> 1 & 1) + row * row * (corner >> 2));
}

/* A coefficient is the sum of its determinants times this. */
double iccp_cell_weight(const iccp_cell *cell, size_t coefficient);

/* Reads the edges of the cell whose first corner is the sample at i. Returns false if a corner is
 * not finite. `sign` is that of the grid's determinant. */
bool iccp_cell_read(iccp_cell *cell, const icc_field *field, const size_t *i, int sign);

/* Makes a cell with one coefficient, the determinant of the grid's own steps. Returns false if a
 * step is not finite. */
bool iccp_cell_read_grid(iccp_cell *cell, const icc_field *field);

/* Computes the bounds. Returns false if the cell's numbers are too large or small for them. */
bool iccp_cell_bound(iccp_cell_bounds *out, const iccp_cell *cell);

#endif
