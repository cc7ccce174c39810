/* Points in square cells, for finding those near a place. */
#ifndef ICCP_CELLS_H
#define ICCP_CELLS_H

#include "base/env.h"

#include <stdbool.h>

typedef struct iccp_cells {
    iccp_memory memory;
    size_t dim, n;
    const double *points; /* borrowed */
    double lower[3], side;
    size_t shape[3]; /* cell (i, j, k) has the number i + shape[0] * (j + shape[1] * k); 1
                        beyond dim */
    uint32_t *first; /* of each cell in `order`, and one more */
    uint32_t *order; /* the points, cell after cell, ascending in each */
} iccp_cells;

/* Cells about as wide as `side`, wider if there would be more than 4 a point. */
icc_status iccp_cells_create(iccp_cells *cells, size_t dim, size_t n, const double *points,
                             double side, const iccp_env *env);
void iccp_cells_free(iccp_cells *cells);

/* Writes the points within a radius of a place, at most `capacity` of them, in a fixed order, and
 * returns how many there are. */
size_t iccp_cells_near(const iccp_cells *cells, const double *place, double radius, size_t capacity,
                       uint32_t *near);

/* Cells from..to along each axis, both included. */
typedef struct iccp_cell_box {
    size_t from[3], to[3];
} iccp_cell_box;

/* The cells that a ball reaches into, of those there are; false if there are none. For loops that
 * cannot afford iccp_cells_near(): along the first axis the points of neighbouring cells follow
 * each other in `order`. */
bool iccp_cells_box(const iccp_cells *cells, const double *place, double radius,
                    iccp_cell_box *box);

#endif
