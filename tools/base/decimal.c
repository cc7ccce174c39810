/* Numbers of usual size go through exact integers. A double is m 2^e, so its first digits are the
 * whole part of m 5^k 2^(e + k) for some k, and 128 bits hold this product. A decimal number with
 * few digits is the quotient of two doubles that are exact, which the machine rounds correctly
 * (Clinger, How to Read Floating Point Numbers Accurately). All other numbers take the way of the C
 * library. */
#include "base/decimal.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The digits of a number, without its point: value = digits 10^(exponent + 1 - n). */
typedef struct decimal {
    uint64_t digits;
    int n, exponent;
} decimal;

/* Powers of ten that a double holds exactly. */
static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
enum { MAX_POWER = sizeof powers / sizeof *powers - 1 };

static uint64_t integer_power(uint64_t base, int exponent)
{
    uint64_t power = 1;
    for (; exponent > 0; exponent /= 2, base *= base)
        power *= exponent % 2 == 1 ? base : 1;
    return power;
}

/* Computes a b / 2^shift for 0 < shift < 64, rounded to the nearest integer, and to the even one
 * of two. The result has less than 64 bits. */
static uint64_t scaled_product(uint64_t a, uint64_t b, int shift)
{
    uint64_t a0 = a & UINT32_MAX, a1 = a >> 32, b0 = b & UINT32_MAX, b1 = b >> 32;
    uint64_t first = a0 * b0, second = a1 * b0 + (first >> 32);
    uint64_t third = a0 * b1 + (second & UINT32_MAX);
    uint64_t low = third << 32 | (first & UINT32_MAX);
    uint64_t high = a1 * b1 + (second >> 32) + (third >> 32);
    uint64_t whole = high << (64 - shift) | low >> shift;
    uint64_t rest = low << (64 - shift), half = (uint64_t)1 << 63;
    return whole + (rest > half || (rest == half && whole % 2 == 1));
}

/* Takes a positive number apart: value = mantissa 2^exponent. */
static uint64_t take_apart(double value, int *exponent)
{
    enum { STORED = DBL_MANT_DIG - 1 };
    uint64_t bits, hidden = (uint64_t)1 << STORED;
    memcpy(&bits, &value, sizeof bits);
    *exponent = (int)(bits >> STORED) + DBL_MIN_EXP - 1 - DBL_MANT_DIG;
    return (bits & (hidden - 1)) | hidden;
}

/* Finds the first n digits of a positive number, rounded. False if it is too large or too small. */
static bool find_digits(decimal *out, double value, int n)
{
    int binary, power = 0;
    if (!(value >= 1e-4 && value < 1e15))
        return false;
    while (value >= powers[power + 1])
        power++;
    /* The doubles 1e-1 to 1e-4 are the least ones that are not below these numbers. */
    power = value >= 1 ? power : value >= 1e-1 ? -1 : value >= 1e-2 ? -2 : value >= 1e-3 ? -3 : -4;
    uint64_t mantissa = take_apart(value, &binary);
    int k = n - 1 - power, shift = -(binary + k);
    if (shift <= 0 || shift >= 64)
        return false;
    *out = (decimal){scaled_product(mantissa, integer_power(5, k), shift), n, power};
    if (out->digits == integer_power(10, n)) {
        out->digits /= 10;
        out->exponent++;
    }
    return out->exponent < n;
}

/* Writes a number in fixed style, without zeros at its end. */
static size_t put_digits(char *text, decimal d)
{
    int n_whole = d.exponent + 1;
    size_t length = 0;
    for (; d.n > 1 && d.n > n_whole && d.digits % 10 == 0; d.n--)
        d.digits /= 10;
    int n_zeros = n_whole > 0 ? 0 : 1 - n_whole, n_chars = n_zeros + d.n;
    bool point = n_whole < d.n;
    length = (size_t)n_chars + point;
    text[length] = '\0';
    size_t at = length;
    for (int i = n_chars; i-- > 0; d.digits /= 10) {
        text[--at] = (char)('0' + d.digits % 10);
        if (point && i == (n_whole > 0 ? n_whole : 1))
            text[--at] = '.';
    }
    return length;
}

static size_t put(char *text, double value, decimal d)
{
    size_t sign = value < 0;
    text[0] = '-';
    return sign + put_digits(text + sign, d);
}

size_t decimal_write(char text[DECIMAL_ROOM], double value)
{
    decimal d;
    return find_digits(&d, fabs(value), 17) ? put(text, value, d)
                                            : (size_t)snprintf(text, DECIMAL_ROOM, "%.17g", value);
}

/* The machine rounds each quotient to a double at once. */
static bool has_exact_quotients(void)
{
    return FLT_EVAL_METHOD == 0;
}

/* True if digits read back as the value. */
static bool reads_back(decimal d, double value)
{
    int power = d.n - 1 - d.exponent;
    double read = (double)d.digits / powers[power];
    return !(read < value || read > value);
}

size_t decimal_write_short(char text[DECIMAL_ROOM], double value)
{
    decimal d;
    if (has_exact_quotients() && find_digits(&d, fabs(value), DBL_DIG))
        return reads_back(d, fabs(value)) ? put(text, value, d) : decimal_write(text, value);
    int length = snprintf(text, DECIMAL_ROOM, "%.15g", value);
    double read = strtod(text, NULL);
    return read < value || read > value ? decimal_write(text, value) : (size_t)length;
}

/* Adds the digits at p to a number until it has more of them than a double holds. */
static const char *add_digits(const char *p, uint64_t *digits)
{
    for (; *p >= '0' && *p <= '9' && *digits >> DBL_MANT_DIG == 0; p++)
        *digits = 10 * *digits + (uint64_t)(*p - '0');
    return p;
}

double decimal_read(const char *p)
{
    bool negative = *p == '-', point;
    uint64_t digits = 0;
    const char *end = add_digits(p + negative, &digits), *part = end;
    point = *end == '.' && end > p + negative;
    if (point)
        end = add_digits(++part, &digits);
    bool whole = end > p + negative && !(*end >= '0' && *end <= '9') && *end != '.' &&
                 (*end | 0x20) != 'e' && (*end | 0x20) != 'x';
    if (!has_exact_quotients() || !whole || digits >> DBL_MANT_DIG != 0 || end - part > MAX_POWER)
        return strtod(p, NULL);
    double value = (double)digits / powers[end - part];
    return negative ? -value : value;
}
