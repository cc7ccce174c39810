/* Exact signs of small determinants.
 *
 * Source: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates, 1997. A filter in plain doubles decides most signs. Exact expansions decide the rest.
 *
 * Words of this folder. Begin with this file for geometry, and with math/spd.h for linear systems.
 * - predicate: a function that returns the exact sign of a determinant: -1, 0 or +1.
 * - expansion: an exact sum of doubles (expansion.h).
 * - filter: a test in doubles with an error bound, which decides a sign if the bound allows.
 * - factor, supernode, panel, strip: L D L^T of a sparse matrix (ldlt.h); columns of L with the
 *   same rows (supernodes.h); their dense block (panel.h); four of its rows.
 * - order: the sequence in which rows are eliminated (ordering.h, etree.h).
 * - scaled: numbers beyond the range of double (scaled.h).
 * - to within 0.6 ulp: error bound of the functions in elementary.h, in units in the last place.
 *
 * Ways
 * - Signs: predicates.c in the plane, orient3d.c in space, orient.h in up to six dimensions,
 *   exact up to three.
 * - Linear systems: ldlt.c orders and analyses, ldlt_factorise.c factorises, ldlt_solve.c solves,
 *   ldlt_scaled.c for scaled numbers. dense.h has the inner loops, subtrees.h the parts for
 *   threads. pcg.h iterates instead. gram.h makes normal equations.
 * - Functions of elementary.h: exponential.c, angle.c, root.c. Eigenvectors: jacobi.h.
 *
 * Invariants: all results have the same bits on every machine and for every number of threads.
 * Predicates are exact for finite arguments that are 0 or have magnitudes in [2^-200, 2^200];
 * lib/domain brings every shape into that range. */
#ifndef ICCP_PREDICATES_H
#define ICCP_PREDICATES_H

#include "base/compiler.h"

#include <math.h>

/* Relative error of the filter: (3 + 16 eps) eps with eps = 2^-53 (Shewchuk, section 4.2). */
#define ICCP_CROSS_ERROR 3.3306690738754716e-16

/* Exact part of iccp_cross_sign(), for signs that its filter cannot decide. */
int iccp_cross_sign_exact(double a, double b, double c, double d, double e, double f, double g,
                          double h);

/* The sign of (a - b)(c - d) - (e - f)(g - h). */
static inline int iccp_cross_sign(double a, double b, double c, double d, double e, double f,
                                  double g, double h)
{
    const double left = (a - b) * (c - d);
    const double right = (e - f) * (g - h);
    const double cross = left - right;
    /* Equality holds only if both products are exactly zero. */
    if (ICCP_LIKELY(fabs(cross) >= ICCP_CROSS_ERROR * (fabs(left) + fabs(right))))
        return (cross > 0.0) - (cross < 0.0);
    return iccp_cross_sign_exact(a, b, c, d, e, f, g, h);
}

/* +1 when a, b, c make a left turn (counter-clockwise with y upwards). */
static inline int iccp_orient2d(const double a[2], const double b[2], const double c[2])
{
    return iccp_cross_sign(a[0], c[0], b[1], c[1], a[1], c[1], b[0], c[0]);
}

/* Twice the signed area of a, b, c, positive for a left turn. Accurate to a few rounding errors
 * however flat the triangle is, unless the coordinates themselves hardly distinguish it from a
 * line. */
double iccp_area2d(const double a[2], const double b[2], const double c[2]);

/* Exact part of iccp_orient3d(), for signs that its filter cannot decide. `det` is the determinant
 * that the filter computed, and `permanent` the sum of the absolute values of its terms. */
int iccp_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3],
                        double det, double permanent);

/* Relative error of the filter: (7 + 56 eps) eps (Shewchuk, section 4.3). */
#define ICCP_ORIENT3D_ERROR 7.7715611723761027e-16

/* +1 when d lies on the side of the plane from which a, b, c appear counter-clockwise. */
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

/* +1 when d lies inside the circle through a, b, c, which must be counter-clockwise. */
int iccp_incircle(const double a[2], const double b[2], const double c[2], const double d[2]);

#endif
