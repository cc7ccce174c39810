/* Exact orientation of four points in space. Based on: J. R. Shewchuk, Adaptive Precision
 * Floating-Point Arithmetic and Fast Robust Geometric Predicates, Discrete & Computational Geometry
 * 18, 1997, section 4.3. The stages are those of math/predicates.c. */
#include "math/predicates.h"

#include "base/minmax.h"
#include "math/expansion.h"

/* Relative error of the determinant of the rounded differences, (3 + 28 eps) eps. */
static const double det_error_2 = 3.330669073875473e-16;

/* The exact determinant with the rows b, a, c. h has room for 24 components. */
static size_t det_of_differences(double *h, const double a[3], const double b[3], const double c[3])
{
    const double *const rows[3] = {b, a, c};
    double minor[4], term[3][8], two[16];
    size_t n[3];
    for (int i = 0; i < 3; ++i) {
        const double *p = rows[(i + 1) % 3], *q = rows[(i + 2) % 3];
        const size_t n_minor = iccp_expansion_cross(minor, p[0], q[1], p[1], q[0]);
        n[i] = iccp_expansion_scale(term[i], n_minor, minor, rows[i][2]);
    }
    const size_t n_two = iccp_expansion_sum(two, n[0], term[0], n[1], term[1]);
    return iccp_expansion_sum(h, n_two, two, n[2], term[2]);
}

/* Sign of the determinant of the unrounded differences from d. */
static int orient3d_full(const double a[3], const double b[3], const double c[3], const double d[3])
{
    const double *const rows[3] = {b, a, c};
    double left[8], right[8], minor[16], z[2], low[32], high[32], term[3][64], two[128], det[192];
    size_t n[3];
    for (int i = 0; i < 3; ++i) {
        const double *p = rows[(i + 1) % 3], *q = rows[(i + 2) % 3];
        const size_t n_left = iccp_expansion_product_of_differences(left, p[0], d[0], q[1], d[1]);
        const size_t n_right = /* subtracted */
            iccp_expansion_product_of_differences(right, d[1], p[1], q[0], d[0]);
        const size_t n_minor = iccp_expansion_sum(minor, n_left, left, n_right, right);
        z[1] = iccp_two_sum(rows[i][2], -d[2], &z[0]);
        const size_t n_low = iccp_expansion_scale(low, n_minor, minor, z[0]);
        const size_t n_high = iccp_expansion_scale(high, n_minor, minor, z[1]);
        n[i] = iccp_expansion_sum(term[i], n_low, low, n_high, high);
    }
    const size_t n_two = iccp_expansion_sum(two, n[0], term[0], n[1], term[1]);
    return iccp_expansion_sign(iccp_expansion_sum(det, n_two, two, n[2], term[2]), det);
}

/* Returns whether nine numbers are multiples of one unit and at most 2^16 units; see
 * are_few_units() in math/predicates.c. The determinant is then below 2^51 units, so plain doubles
 * hold it exactly. */
static int are_few_units(double x[3][3])
{
    double largest = 0.0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            largest = iccp_max(largest, fabs(x[i][k]));
    const double round = 0x1p37 * largest;
    int exact = 1;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            exact &= (x[i][k] + round) - round == x[i][k];
    return exact;
}

int iccp_orient3d_exact(const double a[3], const double b[3], const double c[3], const double d[3],
                        double det, double permanent)
{
    if (permanent == 0.0)
        return 0;
    double difference[3][3], sum[24], tail;
    const double *const points[3] = {a, b, c};
    int rounded = 0;
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k) {
            difference[i][k] = iccp_two_sum(points[i][k], -d[k], &tail);
            rounded |= tail != 0.0;
        }
    if (!rounded && are_few_units(difference))
        return (det > 0.0) - (det < 0.0);
    const size_t n = det_of_differences(sum, difference[0], difference[1], difference[2]);
    if (!rounded || fabs(iccp_expansion_estimate(n, sum)) >= det_error_2 * permanent)
        return iccp_expansion_sign(n, sum);
    return orient3d_full(a, b, c, d);
}
