/* The order of points q of a shape by how near they are to a point p far away.
 *
 * Squared distances from there are all |p|^2 up to rounding. So |q|^2 / (2 |p|) - q . p / |p| is
 * compared instead: half the difference between the squared distance and |p|^2, over |p|. It orders
 * points in the same way and is as exact as q. */
#ifndef ICCP_AWAY_H
#define ICCP_AWAY_H

#include "icc/base.h"

#include <math.h>
#include <stdbool.h>

typedef struct iccp_away {
    const double *p;                     /* borrowed */
    double direction[ICC_MAX_DIM], bend; /* p / |p| and 1 / (2 |p|) */
} iccp_away;

/* Draws a point in local coordinates near enough for products of three coordinates to be finite, in
 * the same direction, and makes coordinates 0 of which a product might underflow. Of one that is
 * not finite something finite is made. */
void iccp_away_reach(size_t dim, const double *p, double *reachable);

/* Whether the number above loses no more to rounding than the squared distance: shapes in local
 * coordinates have a size of about 1. */
static inline bool iccp_away_is_far(size_t dim, const double *p)
{
    for (size_t k = 0; k < dim; ++k)
        if (fabs(p[k]) > 1024)
            return true;
    return false;
}

/* For a point within reach that is far away. */
iccp_away iccp_away_from(size_t dim, const double *p);

/* The number. */
double iccp_away_value(const iccp_away *away, size_t dim, const double *q);

/* The least of a box. */
double iccp_away_bound(const iccp_away *away, size_t dim, const double *lower, const double *upper);

#endif
