/* Numbers beyond the range of double: fraction * 2^exponent. */
#ifndef ICCP_SCALED_H
#define ICCP_SCALED_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* The exponent of 0. It is lower than any other, but adding exponents does not overflow. */
#define ICCP_ZERO_EXPONENT (INT32_MIN / 4)

/* A vector of such numbers. A number is normalised if |fraction| is in [0.5, 1), or if it is 0 with
 * ICCP_ZERO_EXPONENT. */
typedef struct iccp_scaled {
    double *fraction; /* one per entry, like `exponent` */
    int32_t *exponent;
} iccp_scaled;

/* frexp() and ldexp() without a function call if x and the result are normal numbers. The exponent
 * is a field of the double with bias 1023. For a fraction in [0.5, 1) the field holds 1022. */
static inline double iccp_frexp(double x, int *exponent)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const int field = (int)(bits >> 52 & 0x7ff);
    if (field == 0 || field == 0x7ff)
        return frexp(x, exponent);
    *exponent = field - 1022;
    bits = (bits & ~((uint64_t)0x7ff << 52)) | (uint64_t)1022 << 52;
    memcpy(&x, &bits, sizeof bits);
    return x;
}

/* For |x| in [0.5, 2) or 0. */
static inline double iccp_ldexp(double x, int32_t exponent)
{
    if (exponent < -1021 || exponent > 1022)
        return ldexp(x, exponent);
    const uint64_t bits = (uint64_t)(exponent + 1023) << 52;
    double power;
    memcpy(&power, &bits, sizeof bits);
    return x * power;
}

/* Stores x * 2^exponent in normalised form. x is finite. */
static inline void iccp_scaled_set(const iccp_scaled *vector, size_t i, double x, int32_t exponent)
{
    int shift;
    vector->fraction[i] = iccp_frexp(x, &shift);
    vector->exponent[i] =
        vector->fraction[i] < 0 || vector->fraction[i] > 0 ? exponent + shift : ICCP_ZERO_EXPONENT;
}

/* Entry i times 2^-exponent as a double, or 0 if that is too small for a double. */
static inline double iccp_scaled_get(const iccp_scaled *vector, size_t i, int32_t exponent)
{
    const int32_t shift = vector->exponent[i] - exponent;
    return shift < -2000 ? 0.0 : iccp_ldexp(vector->fraction[i], shift);
}

/* Returns -1, 0 or 1 if entry i is smaller than, equal to or larger than entry j. Both are
 * normalised and not negative. */
static inline int iccp_scaled_compare(const iccp_scaled *vector, size_t i, size_t j)
{
    const int32_t a = vector->exponent[i], b = vector->exponent[j];
    if (a != b)
        return a > b ? 1 : -1;
    const double x = vector->fraction[i], y = vector->fraction[j];
    return (x > y) - (x < y);
}

#endif
