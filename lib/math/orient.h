/* Orientation of n + 1 points in n dimensions, n = 0..6. It is the sign of the determinant whose
 * rows are points 1 to n minus point 0. Exact for n <= 3, for arguments in the range of
 * math/predicates.h. */
#ifndef ICCP_ORIENT_H
#define ICCP_ORIENT_H

#include <stddef.h>

enum { ICCP_ORIENT_MAX = 6 };

/* The determinant, rounded. It is 1 for n = 0. */
double iccp_orient_value(size_t n, const double *const *points);

/* Returns -1, 0 or +1. For n > 3 it computes in doubles and also returns 0 for points that are too
 * close to one hyperplane. */
int iccp_orient(size_t n, const double *const *points);

/* Like iccp_orient(), with the last point moved by (e, e^2, e^3, ...) for an infinitesimal e > 0.
 * So the result is 0 only if the other points do not span n - 1 dimensions. */
int iccp_orient_beside(size_t n, const double *const *points);

#endif
