/* Nearest points on simplices of any dimension. */
#ifndef ICCP_SIMPLEX_H
#define ICCP_SIMPLEX_H

#include "geometry/away.h"

#include <stddef.h>

/* Finds the point nearest to p of a simplex with n <= 6 corners, of dim coordinates each. Returns
 * the squared distance and writes the barycentric coordinates, which are not negative and have sum
 * 1 up to rounding. The distance is 0 only if p is a corner, which then has coordinate 1. The
 * simplex may be flat. */
double iccp_simplex_nearest(size_t dim, size_t n, const double *const *corners, const double *p,
                            double *bary);

/* Like iccp_simplex_nearest(), for a point far away. Returns the order value (geometry/away.h). */
double iccp_simplex_nearest_from(size_t dim, size_t n, const double *const *corners,
                                 const iccp_away *away, double *bary);

#endif
