/* Points in square cells, to find those near a place. */
#ifndef ICCP_CELLS_H
#define ICCP_CELLS_H

#include "base/env.h"

#include <stdbool.h>

typedef struct iccp_cells {
    iccp_memory memory;
    size_t dim, n;
    const double *points; /* borrowed */
    double lower[3], side;
    /* Cell (i, j, k) has the number i + shape[0] * (j + shape[1] * k); 1 beyond dim */
    size_t shape[3];
    uint32_t *first; /* where each cell begins in `order`, and the end */
    uint32_t *order; /* points, cell after cell, ascending in each */
} iccp_cells;

/* Makes cells about as wide as `side`, or wider if there would be more than 4 per point. */
icc_status iccp_cells_create(iccp_cells *cells, size_t dim, size_t n, const double *points,
                             double side, const iccp_env *env);
void iccp_cells_free(iccp_cells *cells);

/* Writes the points within a radius of a place, at most `capacity`, in a fixed order. Returns their
 * number. */
size_t iccp_cells_near(const iccp_cells *cells, const double *place, double radius, size_t capacity,
                       uint32_t *near);

/* The cells from `from` to `to` along each axis, both included. */
typedef struct iccp_cell_box {
    size_t from[3], to[3];
} iccp_cell_box;

/* Finds the existing cells that a ball touches. Returns false if there are none. It is for loops
 * that cannot afford iccp_cells_near(): along the first axis, points of neighbouring cells are
 * consecutive in `order`. */
bool iccp_cells_box(const iccp_cells *cells, const double *place, double radius,
                    iccp_cell_box *box);

#endif
