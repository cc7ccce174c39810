/* Sums of doubles without rounding errors.
 *
 * Based on: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates, Discrete & Computational Geometry 18, 1997, sections 2.2 to 2.6.
 *
 * An expansion is an array of non-zero doubles that do not overlap, the smallest magnitude first.
 * Its value is their exact sum, and its sign that of the last one. Zero is the empty expansion.
 * Results are exact as long as nothing overflows and every product of two last places stays above
 * 2^-1074. This requires plain double arithmetic, rounded to even, without fused operations and
 * without excess precision. */
#ifndef ICCP_EXPANSION_H
#define ICCP_EXPANSION_H

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Value 1 also leaves doubles alone; GCC reports it on s390x with -std=c11. */
_Static_assert((FLT_EVAL_METHOD == 0 || FLT_EVAL_METHOD == 1) && FLT_RADIX == 2 &&
                   DBL_MANT_DIG == 53,
               "the exact predicates need IEEE 754 doubles without excess precision");

/* a + b = result + *error. */
static inline double iccp_two_sum(double a, double b, double *error)
{
    const double sum = a + b;
    const double b_part = sum - a;
    *error = (a - (sum - b_part)) + (b - b_part);
    return sum;
}

/* a + b = result + *error, for |a| >= |b| or a = 0. */
static inline double iccp_fast_two_sum(double a, double b, double *error)
{
    const double sum = a + b;
    *error = b - (sum - a);
    return sum;
}

/* The upper 26 bits of a. The remainder also fits into 26 bits. */
static inline double iccp_upper_half(double a)
{
    const double c = 134217729.0 * a; /* 2^27 + 1 */
    return c - (c - a);
}

/* a b = result + *error. */
static inline double iccp_two_product(double a, double b, double *error)
{
    const double product = a * b;
    const double a_high = iccp_upper_half(a), a_low = a - a_high;
    const double b_high = iccp_upper_half(b), b_low = b - b_high;
    *error = a_low * b_low - (((product - a_high * b_high) - a_low * b_high) - a_high * b_low);
    return product;
}

/* Appends a component unless it is zero. Returns the new length. */
static inline size_t iccp_expansion_push(double *h, size_t n, double component)
{
    h[n] = component;
    return n + (component != 0.0);
}

/* h = a + b. h needs room for 2 components. */
static inline size_t iccp_expansion_two_sum(double *h, double a, double b)
{
    double low;
    const double high = iccp_two_sum(a, b, &low);
    return iccp_expansion_push(h, iccp_expansion_push(h, 0, low), high);
}

/* h = e + f. h needs room for m + n components and is neither e nor f. Returns the length. */
static inline size_t iccp_expansion_sum(double *h, size_t m, const double *e, size_t n,
                                        const double *f)
{
    size_t i = 0, j = 0, length = 0;
    double sum = 0.0, low;
    while (i < m || j < n) {
        const int from_e = j == n || (i < m && fabs(e[i]) < fabs(f[j]));
        sum = iccp_two_sum(sum, from_e ? e[i++] : f[j++], &low);
        length = iccp_expansion_push(h, length, low);
    }
    return sum != 0.0 ? iccp_expansion_push(h, length, sum) : length;
}

/* h = b e. h needs room for 2 m components and is not e. Returns the length. */
static inline size_t iccp_expansion_scale(double *h, size_t m, const double *e, double b)
{
    size_t length = 0;
    double sum = 0.0, low;
    for (size_t i = 0; i < m; ++i) {
        double product_low;
        const double product = iccp_two_product(e[i], b, &product_low);
        sum = iccp_two_sum(sum, product_low, &low);
        length = iccp_expansion_push(h, length, low);
        sum = iccp_fast_two_sum(product, sum, &low);
        length = iccp_expansion_push(h, length, low);
    }
    return sum != 0.0 ? iccp_expansion_push(h, length, sum) : length;
}

/* h = a b - c d. h needs room for 4 components. Returns the length. */
static inline size_t iccp_expansion_cross(double *h, double a, double b, double c, double d)
{
    double left[2], right[2];
    left[1] = iccp_two_product(a, b, &left[0]);
    right[1] = -iccp_two_product(c, d, &right[0]);
    right[0] = -right[0];
    return iccp_expansion_sum(h, 2, left, 2, right);
}

/* h = (a - b)(c - d). h needs room for 8 components. Returns the length. */
static inline size_t iccp_expansion_product_of_differences(double *h, double a, double b, double c,
                                                           double d)
{
    double left[2], low[4], high[4], right_low;
    const double right = iccp_two_sum(c, -d, &right_low);
    const size_t n = iccp_expansion_two_sum(left, a, -b);
    const size_t n_low = iccp_expansion_scale(low, n, left, right_low);
    const size_t n_high = iccp_expansion_scale(high, n, left, right);
    return iccp_expansion_sum(h, n_low, low, n_high, high);
}

/* The value, to within a factor 1 + 2 eps. */
static inline double iccp_expansion_estimate(size_t n, const double *e)
{
    double sum = 0.0;
    for (size_t i = 0; i < n; ++i)
        sum += e[i];
    return sum;
}

/* The sign of the value. */
static inline int iccp_expansion_sign(size_t n, const double *e)
{
    return n == 0 ? 0 : e[n - 1] > 0.0 ? 1 : -1;
}

#endif
