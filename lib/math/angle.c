/* Trigonometric functions. Cosine and sine use Taylor polynomials on an eighth of a turn, after an
 * exact reduction.
 *
 * The angle of a vector uses tan(a - b) = (tan a - tan b) / (1 + tan a tan b). Here tan b is the
 * nearest of 0, 1/8 .. 1, and the Taylor polynomial of the arctangent gives the rest. Values that
 * decide the last place are sums of two doubles, `high + low`. */
#include "math/elementary.h"

#include "math/expansion.h"

#include <stdbool.h>
#include <stdint.h>

static const double TWO_PI_HIGH = 0x1.921fb54442d18p2, TWO_PI_LOW = 0x1.1a62633145c07p-52;
static const double PER_TURN_HIGH = 0x1.45f306dc9c883p-3,
                    PER_TURN_LOW = -0x1.6b01ec5417056p-57; /* 1 / (2 pi) */
static const double QUARTERS_PER_RADIAN = 0x1.45f306dc9c883p-1;
/* pi / 2 is the sum. The first three, times up to 2^20, are exact. */
static const double QUARTER[4] = {0x1.921fb544p0, 0x1.0b4611a6p-34, 0x1.3198a2ep-69,
                                  0x1.b839a252049c1p-104};

/* atan(i / 8) in turns */
static const struct {
    double high, low;
} ATAN[9] = {
    {0x0p0, 0x0p0},
    {0x1.4444750777668p-6, 0x1.b7f9255cb1f1ep-60},
    {0x1.3f670b6bdc73dp-5, 0x1.bbe87e7941244p-61},
    {0x1.d3c3a482f3ab5p-5, -0x1.16f02508c9309p-61},
    {0x1.2e4051d9df308p-4, 0x1.995a23db6b8d4p-58},
    {0x1.6c266f6edfc1ep-4, 0x1.f0066ff5b8be7p-59},
    {0x1.a37f5c4c419efp-4, 0x1.9a97709251caep-59},
    {0x1.d49ab3ac8b1bbp-4, 0x1.41af9789432fbp-58},
    {0x1p-3, 0x0p0},
};

/* The truncation errors are below 2^-58 of the functions. */
static const double SINE[9] = {-1.0 / 6,
                               1.0 / 120,
                               -1.0 / 5040,
                               1.0 / 362880,
                               -1.0 / 39916800,
                               1.0 / 6227020800,
                               -1.0 / 1307674368000,
                               1.0 / 355687428096000,
                               -1.0 / 121645100408832000};
static const double COSINE[7] = {
    1.0 / 24,        -1.0 / 720,         1.0 / 40320,         -1.0 / 3628800,
    1.0 / 479001600, -1.0 / 87178291200, 1.0 / 20922789888000};
static const double ARCUS_TANGENT[7] = {-1.0 / 3,  1.0 / 5,  -1.0 / 7, 1.0 / 9,
                                        -1.0 / 11, 1.0 / 13, -1.0 / 15};

/* Sums even and odd powers separately, which halves the chain of dependent operations. */
static inline double polynomial(int n, const double *coefficient, double x)
{
    const double x2 = x * x;
    double sum[2] = {0, 0};
    while (n-- > 0)
        sum[n & 1] = sum[n & 1] * x2 + coefficient[n];
    return sum[0] + sum[1] * x;
}

/* Cosine and sine of a + b and some quarters of a turn. |a| <= pi / 4, and b is below an ulp of
 * a. */
static void cis_of_sum(double a, double b, int32_t quarters, double z[2])
{
    const double q = a * a, half = 0.5 * q, rest = 1 - half;
    const double s = copysign(a + (b * rest + a * q * polynomial(9, SINE, q)), a);
    const double c = rest + (((1 - rest) - half) + (q * q * polynomial(7, COSINE, q) - a * b));
    const bool odd = quarters & 1, opposite = quarters & 2;
    const double x = odd ? 0 - s : c, y = odd ? c : s;
    z[0] = opposite ? 0 - x : x;
    z[1] = opposite ? 0 - y : y;
}

void iccp_cis_turns(double turns, double z[2])
{
    double low;
    if (!(fabs(turns) < HUGE_VAL)) {
        z[0] = z[1] = NAN;
        return;
    }
    const double rest = turns - round(turns), quarters = floor(4 * rest + 0.5);
    const double eighth = rest - 0.25 * quarters;
    const double high = iccp_two_product(eighth, TWO_PI_HIGH, &low);
    cis_of_sum(high, low + eighth * TWO_PI_LOW, (int32_t)quarters, z);
}

void iccp_cis(double radians, double z[2])
{
    double high = radians, low = 0, error;
    if (!(fabs(radians) < HUGE_VAL)) {
        z[0] = z[1] = NAN;
        return;
    }
    if (fabs(radians) > 0x1p20)
        high = fmod(radians, TWO_PI_HIGH);
    const double quarters = floor(high * QUARTERS_PER_RADIAN + 0.5);
    for (int k = 0; k < 4 && fabs(quarters) > 0; ++k) {
        high = iccp_two_sum(high, -quarters * QUARTER[k], &error);
        low += error;
    }
    cis_of_sum(high, low, (int32_t)quarters, z);
}

/* c x = result + *low, if c has few bits. */
static inline double short_product(double c, double x, double *low)
{
    const double product = c * x, high = iccp_upper_half(x);
    *low = (c * high - product) + c * (x - high);
    return product;
}

/* Angle of (x, y) in turns, as result + *low, for 0 <= y <= x. Products must neither leave the
 * range nor lose digits. The table has the angle whose tangent is i eighths, and a series gives the
 * rest. */
static double first_eighth(double y, double x, double *low)
{
    double c_low, s_low, error, rest;
    const int i = (int)(8 * (y / x) + 0.5);
    const double c = short_product(0.125 * i, x, &c_low);
    const double s = short_product(0.125 * i, y, &s_low);
    const double top = y - c, bottom = iccp_fast_two_sum(x, s, &error);
    const double high = top / bottom, product = iccp_two_product(high, bottom, &rest);
    const double missing = ((top - product) - rest - c_low) - high * (error + s_low);
    const double q = high * high, series = high * q * polynomial(7, ARCUS_TANGENT, q);
    const double turns = iccp_two_product(high, PER_TURN_HIGH, &rest);
    rest += high * PER_TURN_LOW + (missing / bottom + series) * PER_TURN_HIGH;
    const double sum = iccp_fast_two_sum(ATAN[i].high, turns, &error);
    *low = error + (ATAN[i].low + rest);
    return sum;
}

/* Like first_eighth(), for any 0 <= y <= x, x > 0. A tiny y is scaled up first, but stays so small
 * that its arctangent equals its argument. */
static double first_eighth_of_any(double y, double x, double *low)
{
    enum { LEAST = -100 };
    int e_y, e_x;
    if (x < 0x1p400 && y > 0x1p-400)
        return first_eighth(y, x, low);
    y = frexp(y, &e_y);
    x = frexp(x, &e_x);
    const int e = e_y - e_x;
    if (e >= LEAST)
        return first_eighth(ldexp(y, e), x, low);
    const double high = first_eighth(ldexp(y, LEAST), x, low), turns = high + *low;
    *low = 0;
    return ldexp(turns, e - LEAST);
}

/* Extends the angle from the first eighth to the quarter, the half and the whole turn. */
double iccp_atan2_turns(double y, double x)
{
    const bool steep = fabs(y) > fabs(x), backward = copysign(1, x) < 0;
    const double less = steep ? fabs(x) : fabs(y), more = steep ? fabs(y) : fabs(x);
    double high = 0, low = 0, error;
    if (!(less <= more))
        return x + y;
    if (less < HUGE_VAL && more < HUGE_VAL && more > 0)
        high = first_eighth_of_any(less, more, &low);
    else if (!(less < HUGE_VAL))
        high = 0.125;
    if (steep) {
        high = iccp_two_sum(0.25, -high, &error);
        low = error - low;
    }
    if (backward) {
        high = iccp_two_sum(0.5, -high, &error);
        low = error - low;
    }
    return copysign(high + low, y);
}
