/* Exact signs of determinants. Based on: J. R. Shewchuk, Adaptive Precision Floating-Point
 * Arithmetic and Fast Robust Geometric Predicates, Discrete & Computational Geometry 18, 1997,
 * sections 4.2 to 4.4.
 *
 * There are three stages. The first uses plain doubles. The second computes the determinant of the
 * rounded differences exactly. That is the answer if no difference was rounded, as is usual for
 * points close to each other. The third computes everything exactly. Shewchuk's stage between the
 * last two is left out, because inputs that need it are rare. */
#include "math/predicates.h"

#include "math/expansion.h"

/* Relative error of the second stage, with eps = 2^-53: (2 + 12 eps) eps. */
static const double cross_error_2 = 2.2204460492503146e-16;

static int cross_sign_full(double a, double b, double c, double d, double e, double f, double g,
                           double h)
{
    double left[8], right[8], cross[16];
    const size_t n_left = iccp_expansion_product_of_differences(left, a, b, c, d);
    /* Subtracted */
    const size_t n_right = iccp_expansion_product_of_differences(right, f, e, g, h);
    return iccp_expansion_sign(iccp_expansion_sum(cross, n_left, left, n_right, right), cross);
}

int iccp_cross_sign_exact(double a, double b, double c, double d, double e, double f, double g,
                          double h)
{
    double tail[4], cross[4];
    const double ab = iccp_two_sum(a, -b, &tail[0]);
    const double cd = iccp_two_sum(c, -d, &tail[1]);
    const double ef = iccp_two_sum(e, -f, &tail[2]);
    const double gh = iccp_two_sum(g, -h, &tail[3]);
    const size_t n = iccp_expansion_cross(cross, ab, cd, ef, gh);
    const int rounded = tail[0] != 0.0 || tail[1] != 0.0 || tail[2] != 0.0 || tail[3] != 0.0;
    if (!rounded ||
        fabs(iccp_expansion_estimate(n, cross)) >= cross_error_2 * (fabs(ab * cd) + fabs(ef * gh)))
        return iccp_expansion_sign(n, cross);
    return cross_sign_full(a, b, c, d, e, f, g, h);
}

/* The exact cross product of the rounded differences, plus a correction for their rounding. */
double iccp_area2d(const double a[2], const double b[2], const double c[2])
{
    double tail[4], cross[4];
    const double ax = iccp_two_sum(a[0], -c[0], &tail[0]);
    const double by = iccp_two_sum(b[1], -c[1], &tail[1]);
    const double ay = iccp_two_sum(a[1], -c[1], &tail[2]);
    const double bx = iccp_two_sum(b[0], -c[0], &tail[3]);
    const size_t n = iccp_expansion_cross(cross, ax, by, ay, bx);
    return iccp_expansion_estimate(n, cross) +
           ((ax * tail[1] + by * tail[0]) - (ay * tail[3] + bx * tail[2]));
}
