/* Cube roots: a = m 2^e with m in [1, 2). A polynomial approximates m^(-1/3). One step of the
 * series z = z0 (1 - d)^(-1/3) with d = 1 - a z0^3 makes it exact to 50 bits. Then y = a z^2 is cut
 * to 26 bits, so that its cube needs no rounding. A Newton step with its second-order term
 * finishes. There is no division.
 *
 * Lengths: the squares and their sum are kept with their rounding errors. So only the last rounding
 * of the radicand and that of the root remain. */
#include "math/elementary.h"

#include "math/expansion.h"

#include <stdbool.h>
#include <stdint.h>
#include <string.h>

/* m^(-1/3) on [1, 2] to within 2^-14, interpolated at the nodes of Chebyshev's polynomial. */
static const double INVERSE[5] = {1.6662787377309156, -1.1623973573078166, 0.6846527077322325,
                                  -0.21636185469244387, 0.02778280101858424};
/* 2^(-e / 3) */
static const double INVERSE_OF_2[3] = {1, 0x1.965fea53d6e3dp-1, 0x1.428a2f98d728bp-1};

/* The cube root of a = m 2^e in [1, 8). */
static double small_root(double m, double a, int32_t e)
{
    const double *c = INVERSE, m2 = m * m;
    const double first =
        ((c[0] + c[1] * m) + m2 * ((c[2] + c[3] * m) + m2 * c[4])) * INVERSE_OF_2[e];
    const double d = 1 - a * first * (first * first);
    const double z = first + first * d * (1.0 / 3 + d * (2.0 / 9 + d * (14.0 / 81)));
    const double y = iccp_upper_half(a * z * z), square = y * y, high = iccp_upper_half(square);
    const double miss = (a - high * y) - (square - high) * y;
    const double step = miss * (z * z) * (1.0 / 3);
    return y + (step + step * step * z);
}

static double with_exponent(uint64_t fraction, uint64_t biased)
{
    const uint64_t bits = fraction | biased << 52;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* Both 1023, the bias of exponents, and 54 are multiples of 3. */
double iccp_cbrt(double x)
{
    const bool tiny = fabs(x) < DBL_MIN;
    const double positive = tiny ? fabs(x) * 0x1p54 : fabs(x);
    uint64_t bits;
    if (!(positive > 0 && positive < HUGE_VAL))
        return x;
    memcpy(&bits, &positive, sizeof bits);
    const uint64_t exponent = bits >> 52, third = exponent / 3, rest = exponent % 3;
    const uint64_t fraction = bits & (((uint64_t)1 << 52) - 1);
    const double root = small_root(with_exponent(fraction, 1023),
                                   with_exponent(fraction, 1023 + rest), (int32_t)rest);
    return copysign(root * with_exponent(0, third + 1023 - 341 - (tiny ? 18 : 0)), x);
}

/* x^2 = result + *low. */
static double square(double x, double *low)
{
    const double product = x * x, high = iccp_upper_half(x), rest = x - high;
    *low = ((high * high - product) + 2 * high * rest) + rest * rest;
    return product;
}

/* The length of (x, y) for x >= y. x^2 is so far inside the range that the digits of y^2 below the
 * range do not matter. */
static double length(double x, double y)
{
    double x_low, y_low, low;
    const double x_high = square(x, &x_low), y_high = square(y, &y_low);
    const double sum = iccp_fast_two_sum(x_high, y_high, &low);
    return sqrt(sum + (low + (x_low + y_low)));
}

double iccp_hypot(double x, double y)
{
    const double a = fabs(x), b = fabs(y), more = a > b ? a : b, less = a > b ? b : a;
    int e;
    if (more < 0x1p500 && more > 0x1p-400)
        return length(more, less);
    if (!(a < HUGE_VAL && b < HUGE_VAL))
        return a > DBL_MAX || b > DBL_MAX ? HUGE_VAL : a + b;
    const double fraction = frexp(more, &e);
    return ldexp(length(fraction, ldexp(less, -e)), e);
}
