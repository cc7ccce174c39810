/* The point of a convex hull that is nearest to the origin. */
#ifndef ICCP_MINNORM_H
#define ICCP_MINNORM_H

#include <stddef.h>

/* The hull of n >= 1 points with dim <= ICC_MAX_DIM coordinates each, none longer than about 1.
 * Writes the nearest point and returns the least of its products with the points, divided by its
 * length: positive if and only if there is a vector that has a positive product with all of them;
 * of these, its direction has the largest least product. 0 when the origin is in the hull, up to
 * rounding. */
double iccp_minnorm(size_t dim, size_t n, const double *points, double *nearest);

#endif
