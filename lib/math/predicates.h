/* Exact signs of small determinants, after J. R. Shewchuk, Adaptive Precision Floating-Point
 * Arithmetic and Fast Robust Geometric Predicates, 1997: a filter in plain doubles, exact
 * expansions when it cannot tell.
 *
 * Exact for finite arguments whose non-zero magnitudes lie in [2^-200, 2^200]; the domain module
 * brings every shape into that range. Each returns -1, 0 or +1. */
#ifndef ICCP_PREDICATES_H
#define ICCP_PREDICATES_H

#include "base/compiler.h"

#include <math.h>

/* The filter's relative error, (3 + 16 eps) eps with eps = 2^-53 (Shewchuk, section 4.2). */
#define ICCP_CROSS_ERROR 3.3306690738754716e-16

/* iccp_cross_sign() for when its filter cannot tell. */
int iccp_cross_sign_exact(double a, double b, double c, double d, double e, double f, double g,
                          double h);

/* The sign of (a - b)(c - d) - (e - f)(g - h). */
static inline int iccp_cross_sign(double a, double b, double c, double d, double e, double f,
                                  double g, double h)
{
    const double left = (a - b) * (c - d);
    const double right = (e - f) * (g - h);
    const double cross = left - right;
    /* Equality holds when both products are zero, and then they are so exactly. */
    if (ICCP_LIKELY(fabs(cross) >= ICCP_CROSS_ERROR * (fabs(left) + fabs(right))))
        return (cross > 0.0) - (cross < 0.0);
    return iccp_cross_sign_exact(a, b, c, d, e, f, g, h);
}

/* +1 when a, b, c make a left turn (counter-clockwise with y upwards). */
static inline int iccp_orient2d(const double a[2], const double b[2], const double c[2])
{
    return iccp_cross_sign(a[0], c[0], b[1], c[1], a[1], c[1], b[0], c[0]);
}

/* Twice the area of a, b, c, positive when they make a left turn, to a few rounding errors of
 * itself however flat the triangle is, unless the coordinates themselves hardly tell it from a
 * line. */
double iccp_area2d(const double a[2], const double b[2], const double c[2]);

/* iccp_orient3d() for when its filter cannot tell. `det` is the determinant and `permanent` the sum
 * of its terms all taken positive, as the filter computed them. */
int iccp_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3],
                        double det, double permanent);

/* The filter's relative error, (7 + 56 eps) eps (Shewchuk, section 4.3). */
#define ICCP_ORIENT3D_ERROR 7.7715611723761027e-16

/* +1 when d lies on the side of the plane through a, b, c from which they look
 * counter-clockwise. */
static inline int iccp_orient3d(const double a[3], const double b[3], const double c[3],
                                const double d[3])
{
    const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
    const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
    const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
    const double axcy = ax * cy, cxay = cx * ay;
    const double cxby = cx * by, bxcy = bx * cy;
    const double bxay = bx * ay, axby = ax * by;
    const double det = bz * (axcy - cxay) + az * (cxby - bxcy) + cz * (bxay - axby);
    const double permanent = fabs(bz) * (fabs(axcy) + fabs(cxay)) +
                             fabs(az) * (fabs(cxby) + fabs(bxcy)) +
                             fabs(cz) * (fabs(bxay) + fabs(axby));
    if (ICCP_LIKELY(fabs(det) > ICCP_ORIENT3D_ERROR * permanent))
        return (det > 0.0) - (det < 0.0);
    return iccp_orient3d_exact(a, b, c, d, det, permanent);
}

/* +1 when d lies inside the circle through a, b, c, which are counter-clockwise. */
int iccp_incircle(const double a[2], const double b[2], const double c[2], const double d[2]);

#endif
