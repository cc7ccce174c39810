/* Finds the point of a convex hull that is nearest to the origin. Source: P. Wolfe, 1976; see
 * minnorm.c. */
#ifndef ICCP_MINNORM_H
#define ICCP_MINNORM_H

#include <stddef.h>

/* The hull is that of n >= 1 points with dim <= ICC_MAX_DIM coordinates each, none longer than
 * about 1. Writes the nearest point. Returns the least of its products with the points, divided by
 * its length.
 *
 * The result is positive if and only if a vector exists that has a positive product with all
 * points. Of all such directions, the nearest point has the largest least product. The result is
 * 0 if the origin is in the hull, up to rounding. */
double iccp_minnorm(size_t dim, size_t n, const double *points, double *nearest);

#endif
