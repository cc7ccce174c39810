/* Orientation of n + 1 points in n dimensions, n = 0..6: the sign of the determinant whose rows are
 * points 1 to n minus point 0. Exact for n <= 3, with what math/predicates.h asks of the
 * arguments. */
#ifndef ICCP_ORIENT_H
#define ICCP_ORIENT_H

#include <stddef.h>

enum { ICCP_ORIENT_MAX = 6 };

/* The determinant, to rounding. It is 1 for n = 0. */
double iccp_orient_value(size_t n, const double *const *points);

/* -1, 0 or +1. Beyond n = 3 in doubles: 0 also when the points are so close to one hyperplane that
 * doubles cannot tell. */
int iccp_orient(size_t n, const double *const *points);

/* The same with the last point moved by (e, e^2, e^3, ...) for an infinitesimal e > 0. So it is 0
 * only if the other points do not span n - 1 dimensions. */
int iccp_orient_beside(size_t n, const double *const *points);

#endif
