/* Points in square cells, for finding those near a place. */
#ifndef ICCP_CELLS_H
#define ICCP_CELLS_H

#include "base/env.h"

typedef struct iccp_cells {
    iccp_memory memory;
    size_t dim, n;
    const double *points; /* borrowed */
    double lower[3], side;
    size_t shape[3];
    uint32_t *first;      /* of each cell in `order`, and one more */
    uint32_t *order;      /* the points, cell after cell, ascending in each */
} iccp_cells;

/* Cells about as wide as `side`, wider if there would be more than 4 a point. */
icc_status iccp_cells_create(iccp_cells *cells, size_t dim, size_t n, const double *points,
                             double side, const iccp_env *env);
void iccp_cells_free(iccp_cells *cells);

/* Writes the points within a radius of a place, at most `capacity` of them, in a fixed order, and returns how many
 * there are. */
size_t iccp_cells_near(const iccp_cells *cells, const double *place, double radius, size_t capacity,
                       uint32_t *near);

#endif
