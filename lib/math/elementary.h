/* Elementary functions with the same bits on every machine: nothing but sums, differences,
 * products, quotients and square roots of doubles, which IEEE 754 rounds correctly, in an order
 * that the source fixes. Errors are in units in the last place of the result (ulp); the bounds lie
 * a little above the greatest ones among five million arguments, many of them hard. Special values
 * (NaN, infinities, zeros with signs) are those of C's functions. */
#ifndef ICCP_ELEMENTARY_H
#define ICCP_ELEMENTARY_H

#include <stddef.h>

/* To within 0.6 ulp; below 2^-1022 to within 1. */
double iccp_exp(double x);

/* The natural logarithm, to within 0.6 ulp. */
double iccp_ln(double x);

/* ln(1 + x), to within 0.6 ulp. */
double iccp_ln1p(double x);

/* x^y for x >= 0 and |y| <= 64, to within 0.6 ulp; below 2^-1022 to within 1. */
double iccp_pow(double x, double y);

/* x^n by multiplication: each rounds. */
static inline double iccp_power(double x, size_t n)
{
    double product = 1;
    for (size_t k = 0; k < n; ++k)
        product *= x;
    return product;
}

/* To within 0.6 ulp. */
double iccp_cbrt(double x);

/* sqrt(x^2 + y^2) without overflow or underflow on the way, to within 1 ulp. */
double iccp_hypot(double x, double y);

/* Cosine and sine of an angle in turns, which is reduced exactly, each to within 0.9 ulp. */
void iccp_cis_turns(double turns, double z[2]);

/* The same of an angle in radians; beyond 2^20 it is changed by up to half an ulp of its own. */
void iccp_cis(double radians, double z[2]);

/* The angle of (x, y) in turns, from -1/2 to 1/2, to within 0.6 ulp; below 2^-1022 to within 1. */
double iccp_atan2_turns(double y, double x);

#endif
