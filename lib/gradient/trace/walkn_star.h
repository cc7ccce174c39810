/* Where a line of steepest ascent continues from a face of the Kuhn triangulation. */
#ifndef ICCP_WALKN_STAR_H
#define ICCP_WALKN_STAR_H

#include "gradient/function/function.h"
#include "gradient/grid/kuhn_simplex.h"

/* A point of the grid, in a simplex and in the interior of one of its faces.
 *
 * The simplex lies in the cell whose lowest corner is simplex.corner[0], and runs along axis[0],
 * axis[1], .. from there. The point's coordinate along axis[k - 1] is low + y[k], and 1 = y[0] >=
 * y[1] >= .. >= y[dim + 1] = 0. Its barycentric coordinate of corner i is y[i] - y[i + 1]. So
 * corner i does not belong to the face if the two are equal, and then they are equal to the bit. */
typedef struct iccp_place {
    iccp_kuhn_simplex simplex;
    uint32_t low[ICC_MAX_DIM]; /* by axis: coordinates of the lowest corner */
    double y[ICC_MAX_DIM + 2];
    unsigned face; /* bit i is set if the face contains corner i */
} iccp_place;

/* The values that a walk climbs: f, or -f downhill. Where f is level, the vertex index takes its
 * place, as if f were perturbed by an infinitesimal amount. */
typedef struct iccp_slope {
    const icc_function *function;
    int direction; /* 1 or -1 */
    bool level;
} iccp_slope;

/* Computes the values at a few vertices, all times the same power of 2. Differences have exact
 * signs. */
void iccp_slope_values(const iccp_slope *slope, size_t n, const uint32_t *vertices, double *values);

/* Finds the steepest face around a place. Candidates are the place's face and all larger faces
 * whose gradient points into them. Moves the place to a simplex of that face and writes its
 * corners. Sets slope->level if f rises into none of them. Returns ICC_ERR_TRACE if the place is a
 * vertex from which nothing rises; then that corner is all there is. */
icc_status iccp_place_find_steepest(iccp_place *place, iccp_slope *slope, unsigned *corners);

#endif
