/* Where a line of steepest ascent continues from a face of the Kuhn triangulation. */
#ifndef ICCP_WALKN_STAR_H
#define ICCP_WALKN_STAR_H

#include "gradient/function/function.h"
#include "gradient/grid/kuhn_simplex.h"

/* A point of the grid: in a simplex, and in the interior of one of its faces.
 *
 * The simplex lies in the cell whose lowest corner is simplex.corner[0], and runs along axis[0],
 * axis[1], .. from there. The point's coordinate along axis[k - 1] is low + y[k], and 1 = y[0]
 * >= y[1] >= .. >= y[dim + 1] = 0. Its barycentric coordinate of corner i is y[i] - y[i + 1], so
 * that corner i does not belong to the face when the two are equal, and then they are so to the
 * bit. */
typedef struct iccp_place {
    iccp_kuhn_simplex simplex;
    uint32_t low[ICC_MAX_DIM]; /* coordinates of the lowest corner, by axis */
    double y[ICC_MAX_DIM + 2];
    unsigned face; /* bit i: corner i */
} iccp_place;

/* The values that a walk climbs: f, or -f downhill. Where f is level, the vertex index takes its
 * place, as if f were perturbed by an infinitesimal amount. */
typedef struct iccp_slope {
    const icc_function *function;
    int direction; /* 1 or -1 */
    bool level;
} iccp_slope;

/* At a few vertices, all times the same power of 2; differences have exact signs. */
void iccp_slope_values(const iccp_slope *slope, size_t n, const uint32_t *vertices, double *values);

/* Among the faces whose closure holds the place's face and whose own gradient points into them,
 * itself included, the steepest: moves the place to a simplex of it and writes its corners there.
 * slope->level is set when f does not rise into any of them. ICC_ERR_TRACE when the place is a
 * vertex from which nothing rises, whose corner then is all there is. */
icc_status iccp_place_find_steepest(iccp_place *place, iccp_slope *slope, unsigned *corners);

#endif
