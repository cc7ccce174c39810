/* Nearest points on simplices of any dimension. */
#ifndef ICCP_SIMPLEX_H
#define ICCP_SIMPLEX_H

#include "geometry/away.h"

#include <stddef.h>

/* The point of the simplex with n <= 6 corners, of dim coordinates each, that is nearest to p:
 * returns the squared distance and writes its barycentric coordinates, not negative, of sum 1 up to
 * rounding. The distance is 0 only if p is a corner, which then has coordinate 1. A flat simplex is
 * fine. */
double iccp_simplex_nearest(size_t dim, size_t n, const double *const *corners, const double *p,
                            double *bary);

/* The same for a point far away. Returns the order value (geometry/away.h). */
double iccp_simplex_nearest_from(size_t dim, size_t n, const double *const *corners,
                                 const iccp_away *away, double *bary);

#endif
