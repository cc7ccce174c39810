/* Elementary functions with the same bits on every machine. They use only sums, differences,
 * products, quotients and square roots of doubles, in an order that the source fixes. IEEE 754
 * rounds all of these correctly.
 *
 * Errors are in units in the last place of the result (ulp). The bounds lie a little above the
 * largest errors among five million arguments, many of them hard. Special values (NaN, infinities,
 * signed zeros) are those of C's functions. */
#ifndef ICCP_ELEMENTARY_H
#define ICCP_ELEMENTARY_H

#include <stddef.h>

/* e^x to within 0.6 ulp, or 1 ulp below 2^-1022. */
double iccp_exp(double x);

/* Natural logarithm, to within 0.6 ulp. */
double iccp_ln(double x);

/* ln(1 + x), to within 0.6 ulp. */
double iccp_ln1p(double x);

/* x^y for x >= 0 and |y| <= 64, to within 0.6 ulp, or 1 ulp below 2^-1022. */
double iccp_pow(double x, double y);

/* x^n by multiplication. Each product is rounded. */
static inline double iccp_power(double x, size_t n)
{
    double product = 1;
    for (size_t k = 0; k < n; ++k)
        product *= x;
    return product;
}

/* Cube root, to within 0.6 ulp. */
double iccp_cbrt(double x);

/* sqrt(x^2 + y^2) without intermediate overflow or underflow, to within 1 ulp. */
double iccp_hypot(double x, double y);

/* Cosine and sine of an angle in turns, each to within 0.9 ulp. The angle is reduced exactly. */
void iccp_cis_turns(double turns, double z[2]);

/* Cosine and sine of an angle in radians. Beyond 2^20 the angle itself is changed by up to half an
 * ulp. */
void iccp_cis(double radians, double z[2]);

/* Angle of (x, y) in turns, from -1/2 to 1/2, to within 0.6 ulp, or 1 ulp below 2^-1022. */
double iccp_atan2_turns(double y, double x);

#endif
