/* Numbers of usual size go through exact integers. A double is m 2^e, so its first digits are the
 * whole part of m 5^k 2^(e + k) for some k, and 128 bits hold this product. A decimal number with
 * few digits is the quotient of two doubles that are exact, which the machine rounds correctly
 * (Clinger, How to Read Floating Point Numbers Accurately). All other numbers take the way of the C
 * library. */
#include "base/decimal.h"

#include <float.h>
#include <math.h>
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

/* Powers of five. */
static const uint64_t fives[] = {1,
                                 5,
                                 25,
                                 125,
                                 625,
                                 3125,
                                 15625,
                                 78125,
                                 390625,
                                 1953125,
                                 9765625,
                                 48828125,
                                 244140625,
                                 1220703125,
                                 6103515625,
                                 30517578125,
                                 152587890625,
                                 762939453125,
                                 3814697265625,
                                 19073486328125,
                                 95367431640625};

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
    int binary;
    if (!(value >= 1e-4 && value < 1e15))
        return false;
    uint64_t mantissa = take_apart(value, &binary);
    /* 2^e is 10^(0.301 e). So this is the power or the one below it. */
    int power = (binary + DBL_MANT_DIG - 1) * 77 / 256;
    if (value >= 1)
        power += value >= powers[power + 1];
    else
        /* The doubles 1e-1 to 1e-4 are the least ones that are not below these numbers. */
        power = value >= 1e-1 ? -1 : value >= 1e-2 ? -2 : value >= 1e-3 ? -3 : -4;
    int k = n - 1 - power, shift = -(binary + k);
    if (shift <= 0 || shift >= 64)
        return false;
    *out = (decimal){scaled_product(mantissa, fives[k], shift), n, power};
    if (out->digits == fives[n] << n) {
        out->digits /= 10;
        out->exponent++;
    }
    return out->exponent < n;
}

enum { MOST_DIGITS = 17, BLOCK = 16 };

/* Writes two digits. */
static void put_pair(char *text, uint32_t pair)
{
    static const char pairs[] = "0001020304050607080910111213141516171819"
                                "2021222324252627282930313233343536373839"
                                "4041424344454647484950515253545556575859"
                                "6061626364656667686970717273747576777879"
                                "8081828384858687888990919293949596979899";
    memcpy(text, pairs + 2 * (size_t)pair, 2);
}

static void put_eight(char *text, uint32_t digits)
{
    uint32_t high = digits / 10000, low = digits % 10000;
    put_pair(text, high / 100);
    put_pair(text + 2, high % 100);
    put_pair(text + 4, low / 100);
    put_pair(text + 6, low % 100);
}

/* Writes a number in fixed style, without zeros at its end. Copies blocks, of which the rest is
 * overwritten or not used. */
static size_t put_digits(char *text, decimal d)
{
    char digits[MOST_DIGITS + BLOCK] = {0};
    char *first = digits + MOST_DIGITS - d.n;
    digits[0] = (char)('0' + d.digits / 10000000000000000);
    put_eight(digits + 1, (uint32_t)(d.digits / 100000000 % 100000000));
    put_eight(digits + 9, (uint32_t)(d.digits % 100000000));
    int n_whole = d.exponent + 1, n = d.n, n_zeros = n_whole > 0 ? 0 : -n_whole;
    while (n > 1 && n > n_whole && first[n - 1] == '0')
        n--;
    memcpy(text, first, BLOCK);
    if (n_whole <= 0) {
        memcpy(text, "0.000", 5);
        n_whole = 0;
    }
    if (n == n_whole) {
        text[n] = '\0';
        return (size_t)n;
    }
    size_t point = n_whole > 0 ? (size_t)n_whole : 1, part = point + 1 + (size_t)n_zeros;
    text[point] = '.';
    memcpy(text + part, first + n_whole, MOST_DIGITS);
    size_t length = part + (size_t)(n - n_whole);
    text[length] = '\0';
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

/* True if 15 digits cannot read back as the number with these 17. They are off by at most half of the
 * last binary digit, which is less than 2^-53 10^17, or 11.2, in units of the last of 17 digits. */
static bool needs_all(decimal d)
{
    unsigned rest = (unsigned)(d.digits % 100);
    return rest >= 12 && rest <= 88;
}

size_t decimal_write_short(char text[DECIMAL_ROOM], double value)
{
    decimal d;
    if (has_exact_quotients() && find_digits(&d, fabs(value), 17) && needs_all(d))
        return put(text, value, d);
    if (has_exact_quotients() && find_digits(&d, fabs(value), DBL_DIG))
        return reads_back(d, fabs(value)) ? put(text, value, d) : decimal_write(text, value);
    int length = snprintf(text, DECIMAL_ROOM, "%.15g", value);
    double read = strtod(text, NULL);
    return read < value || read > value ? decimal_write(text, value) : (size_t)length;
}

/* Adds the digits at p to a number. */
static const char *add_digits(const char *p, uint64_t *digits)
{
    uint64_t sum = *digits;
    for (; *p >= '0' && *p <= '9'; p++)
        sum = 10 * sum + (uint64_t)(*p - '0');
    *digits = sum;
    return p;
}

bool decimal_read_plain(const char *p, const char **end, double *value)
{
    enum { FIT = 19 }; /* digits, in 64 bits */
    bool negative = *p == '-';
    const char *first = p + negative;
    uint64_t digits = 0;
    const char *at = add_digits(first, &digits), *part = at;
    if (*at == '.' && at > first)
        at = add_digits(++part, &digits);
    if (!has_exact_quotients() || at == first || at - first > FIT || digits >> DBL_MANT_DIG != 0 ||
        *at == '.' || (*at | 0x20) == 'e' || (*at | 0x20) == 'x')
        return false;
    double size = (double)digits / powers[at - part];
    *value = negative ? -size : size;
    *end = at;
    return true;
}

double decimal_read(const char *p)
{
    const char *end;
    double value;
    return decimal_read_plain(p, &end, &value) ? value : strtod(p, NULL);
}
