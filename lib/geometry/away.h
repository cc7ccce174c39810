/* Orders the points q of a shape by their distance from a point p that is far away.
 *
 * Seen from p, all squared distances are |p|^2 up to rounding. So libicc compares the order value
 * |q|^2 / (2 |p|) - q . p / |p| instead. It is half the difference between the squared distance and
 * |p|^2, divided by |p|. It orders points in the same way and is as exact as q. */
#ifndef ICCP_AWAY_H
#define ICCP_AWAY_H

#include "icc/base.h"

#include <math.h>
#include <stdbool.h>

typedef struct iccp_away {
    const double *p;                     /* borrowed */
    double direction[ICC_MAX_DIM], bend; /* p / |p| and 1 / (2 |p|) */
} iccp_away;

/* Moves a point in local coordinates towards the origin until products of three coordinates are
 * finite. Coordinates so small that a product might underflow become 0. Coordinates that are not
 * finite become finite. */
void iccp_away_reach(size_t dim, const double *p, double *reachable);

/* Returns true if the order value loses no more to rounding than the squared distance. Shapes in
 * local coordinates have a size of about 1. */
static inline bool iccp_away_is_far(size_t dim, const double *p)
{
    for (size_t k = 0; k < dim; ++k)
        if (fabs(p[k]) > 1024)
            return true;
    return false;
}

/* Prepares order values for a far point that iccp_away_reach() returned. */
iccp_away iccp_away_from(size_t dim, const double *p);

/* Returns the order value of q. */
double iccp_away_value(const iccp_away *away, size_t dim, const double *q);

/* Returns the least order value of the points in a box. */
double iccp_away_bound(const iccp_away *away, size_t dim, const double *lower, const double *upper);

/* The point whose nearest points are sought. If it is far away, `away` is not NULL, and order
 * values replace squared distances. */
typedef struct iccp_viewpoint {
    const double *p;
    const iccp_away *away;
} iccp_viewpoint;

#endif
