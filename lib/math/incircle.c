/* On which side of a circle a point lies. Exact, in the stages of predicates.c. */
#include "base/minmax.h"
#include "math/expansion.h"
#include "math/predicates.h"

/* Relative errors of the two stages, with eps = 2^-53: (10 + 96 eps) eps and (4 + 48 eps) eps. */
static const double circle_error = 1.1102230246251577e-15;
static const double circle_error_2 = 4.440892098500632e-16;

/* h = e (x^2 + y^2) for e of at most 12 components. h has room for 8 n. */
static size_t lift(double *h, size_t n, const double *e, double x, double y)
{
    double once[24], x_part[48], y_part[48];
    size_t n_once = iccp_expansion_scale(once, n, e, x);
    const size_t n_x = iccp_expansion_scale(x_part, n_once, once, x);
    n_once = iccp_expansion_scale(once, n, e, y);
    const size_t n_y = iccp_expansion_scale(y_part, n_once, once, y);
    return iccp_expansion_sum(h, n_x, x_part, n_y, y_part);
}

/* The exact determinant of the differences a - d, b - d, c - d. h has room for 96. */
static size_t circle_of_differences(double *h, const double a[2], const double b[2],
                                    const double c[2])
{
    double minor[4], a_term[32], b_term[32], c_term[32], ab[64];
    size_t n = iccp_expansion_cross(minor, b[0], c[1], c[0], b[1]);
    const size_t n_a = lift(a_term, n, minor, a[0], a[1]);
    n = iccp_expansion_cross(minor, c[0], a[1], a[0], c[1]);
    const size_t n_b = lift(b_term, n, minor, b[0], b[1]);
    n = iccp_expansion_cross(minor, a[0], b[1], b[0], a[1]);
    const size_t n_c = lift(c_term, n, minor, c[0], c[1]);
    n = iccp_expansion_sum(ab, n_a, a_term, n_b, b_term);
    return iccp_expansion_sum(h, n, ab, n_c, c_term);
}

/* Twice the signed area of a, b, c times |p|^2. h has room for 96. */
static size_t lifted_area(double *h, const double a[2], const double b[2], const double c[2],
                          const double p[2])
{
    double ab[4], bc[4], ca[4], two[8], area[12];
    const size_t n_ab = iccp_expansion_cross(ab, a[0], b[1], b[0], a[1]);
    const size_t n_bc = iccp_expansion_cross(bc, b[0], c[1], c[0], b[1]);
    const size_t n_ca = iccp_expansion_cross(ca, c[0], a[1], a[0], c[1]);
    const size_t n_two = iccp_expansion_sum(two, n_ab, ab, n_bc, bc);
    const size_t n = iccp_expansion_sum(area, n_two, two, n_ca, ca);
    return lift(h, n, area, p[0], p[1]);
}

/* The 4 x 4 determinant with rows (x, y, x^2 + y^2, 1), expanded along its third column. */
static int incircle_full(const double a[2], const double b[2], const double c[2], const double d[2])
{
    double of_a[96], of_b[96], of_c[96], of_d[96], ab[192], cd[192], sum[384];
    const size_t n_a = lifted_area(of_a, b, c, d, a);
    const size_t n_b = lifted_area(of_b, a, d, c, b);
    const size_t n_c = lifted_area(of_c, a, b, d, c);
    const size_t n_d = lifted_area(of_d, a, c, b, d);
    const size_t n_ab = iccp_expansion_sum(ab, n_a, of_a, n_b, of_b);
    const size_t n_cd = iccp_expansion_sum(cd, n_c, of_c, n_d, of_d);
    return iccp_expansion_sign(iccp_expansion_sum(sum, n_ab, ab, n_cd, cd), sum);
}

/* Returns whether six numbers are multiples of one unit and at most 2^12 units. To test this, it
 * adds 2^42 times the largest, so the sum is rounded to such a unit or a larger one. Then no term
 * of the determinant exceeds 2^53 units, and plain doubles hold it exactly. Points on a lattice,
 * which often tie, become cheap. */
static int are_few_units(double x[3][2])
{
    double largest = 0.0;
    for (int i = 0; i < 3; ++i)
        largest = iccp_max(largest, iccp_max(fabs(x[i][0]), fabs(x[i][1])));
    const double round = 0x1p42 * largest;
    int exact = 1;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
            exact &= (x[i][k] + round) - round == x[i][k];
    return exact;
}

/* `circle` is the determinant that the filter computed, and `permanent` the sum of the absolute
 * values of its terms. */
static int incircle_exact(const double a[2], const double b[2], const double c[2],
                          const double d[2], double circle, double permanent)
{
    double difference[3][2], sum[96], tail;
    const double *points[3] = {a, b, c};
    int rounded = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k) {
            difference[i][k] = iccp_two_sum(points[i][k], -d[k], &tail);
            rounded |= tail != 0.0;
        }
    if (!rounded && are_few_units(difference))
        return (circle > 0.0) - (circle < 0.0);
    const size_t n = circle_of_differences(sum, difference[0], difference[1], difference[2]);
    if (!rounded || fabs(iccp_expansion_estimate(n, sum)) >= circle_error_2 * permanent)
        return iccp_expansion_sign(n, sum);
    return incircle_full(a, b, c, d);
}

int iccp_incircle(const double a[2], const double b[2], const double c[2], const double d[2])
{
    const double ax = a[0] - d[0], ay = a[1] - d[1];
    const double bx = b[0] - d[0], by = b[1] - d[1];
    const double cx = c[0] - d[0], cy = c[1] - d[1];
    const double bxcy = bx * cy, cxby = cx * by;
    const double cxay = cx * ay, axcy = ax * cy;
    const double axby = ax * by, bxay = bx * ay;
    const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double circle = a2 * (bxcy - cxby) + b2 * (cxay - axcy) + c2 * (axby - bxay);
    const double permanent = a2 * (fabs(bxcy) + fabs(cxby)) + b2 * (fabs(cxay) + fabs(axcy)) +
                             c2 * (fabs(axby) + fabs(bxay));
    if (ICCP_LIKELY(fabs(circle) > circle_error * permanent))
        return (circle > 0.0) - (circle < 0.0);
    return incircle_exact(a, b, c, d, circle, permanent);
}
