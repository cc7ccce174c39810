/* Exact signs of small determinants, after J. R. Shewchuk, Adaptive Precision Floating-Point
 * Arithmetic and Fast Robust Geometric Predicates, 1997: a filter in plain doubles, exact
 * expansions when it cannot tell.
 *
 * Exact for finite arguments whose non-zero magnitudes lie in [2^-200, 2^200]; the domain module
 * brings every shape into that range. Each returns -1, 0 or +1. */
#ifndef ICCP_PREDICATES_H
#define ICCP_PREDICATES_H

/* +1 when a, b, c make a left turn (counter-clockwise with y upwards). */
int iccp_orient2d(const double a[2], const double b[2], const double c[2]);

/* +1 when d lies inside the circle through a, b, c, which are counter-clockwise. */
int iccp_incircle(const double a[2], const double b[2], const double c[2], const double d[2]);

/* The sign of (a - b)(c - d) - (e - f)(g - h). */
int iccp_cross_sign(double a, double b, double c, double d, double e, double f, double g,
                    double h);

#endif
