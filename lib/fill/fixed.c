/* Exact orientation of dyadic points. A local coordinate is a multiple of 2^-252 and at most a few
 * units large, and a share has 48 bits. So coordinates of points on edges and facets are integers
 * of 300 bits, and a determinant of three has 900 bits. Schoolbook multiplication of the limbs that
 * are not zero in all coordinates is fast enough, because a filter decides most cases. */
#include "fill/fixed.h"

#include <math.h>
#include <string.h>

enum { LIMBS = ICCP_FIXED_LIMBS, UNIT_EXPONENT = 300 };

/* A product of up to three differences, as sign and magnitude. */
typedef struct whole {
    int sign, n;
    uint32_t limb[3 * LIMBS + 2];
} whole;

/* z += value 2^shift, or z -= value 2^shift if negative. */
static void add_shifted(uint32_t *z, uint64_t value, int shift, int negative)
{
    const int first = shift / 32, bits = shift % 32;
    const uint64_t low = value << bits;
    const uint32_t high = bits == 0 ? 0 : (uint32_t)(value >> (64 - bits));
    const uint32_t part[3] = {(uint32_t)low, (uint32_t)(low >> 32), high};
    int64_t carry = 0;
    for (int i = first; i < LIMBS; ++i) {
        const int64_t piece = i - first < 3 ? part[i - first] : 0;
        const int64_t sum = (int64_t)z[i] + (negative ? -piece : piece) + carry;
        z[i] = (uint32_t)((uint64_t)sum & UINT32_MAX);
        carry = sum < 0 ? -1 : sum > (int64_t)UINT32_MAX;
    }
}

void iccp_fixed_add(iccp_fixed *p, const double *x, double share)
{
    const uint64_t s = (uint64_t)ldexp(share, ICCP_FIXED_SHARE_BITS);
    for (int k = 0; k < 3; ++k) {
        if (x[k] == 0.0)
            continue;
        int exponent;
        const uint64_t m = (uint64_t)ldexp(frexp(fabs(x[k]), &exponent), 53);
        const int shift = exponent - 53 - ICCP_FIXED_SHARE_BITS + UNIT_EXPONENT;
        const uint64_t m_low = m & UINT32_MAX, m_high = m >> 32;
        const uint64_t s_low = s & UINT32_MAX, s_high = s >> 32;
        add_shifted(p->limb[k], m_low * s_low, shift, x[k] < 0.0);
        add_shifted(p->limb[k], m_low * s_high, shift + 32, x[k] < 0.0);
        add_shifted(p->limb[k], m_high * s_low, shift + 32, x[k] < 0.0);
        add_shifted(p->limb[k], m_high * s_high, shift + 64, x[k] < 0.0);
    }
}

static void trim(whole *z)
{
    while (z->n > 0 && z->limb[z->n - 1] == 0)
        --z->n;
    if (z->n == 0)
        z->sign = 0;
}

static void subtract(whole *z, const uint32_t *a, const uint32_t *b)
{
    int64_t carry = 0;
    for (int i = 0; i < LIMBS; ++i) {
        const int64_t difference = (int64_t)a[i] - (int64_t)b[i] + carry;
        z->limb[i] = (uint32_t)((uint64_t)difference & UINT32_MAX);
        carry = difference < 0 ? -1 : 0;
    }
    z->n = LIMBS;
    z->sign = 1;
    if (z->limb[LIMBS - 1] >> 31 != 0) {
        uint64_t one = 1;
        for (int i = 0; i < LIMBS; ++i) {
            one += (uint32_t)~z->limb[i];
            z->limb[i] = (uint32_t)one;
            one >>= 32;
        }
        z->sign = -1;
    }
    trim(z);
}

static void multiply(whole *z, const whole *a, const whole *b)
{
    z->sign = a->sign * b->sign;
    z->n = a->n + b->n;
    memset(z->limb, 0, (size_t)z->n * sizeof *z->limb);
    for (int i = 0; i < a->n; ++i) {
        uint64_t carry = 0;
        for (int j = 0; j < b->n; ++j) {
            carry += (uint64_t)a->limb[i] * b->limb[j] + z->limb[i + j];
            z->limb[i + j] = (uint32_t)carry;
            carry >>= 32;
        }
        z->limb[i + b->n] = (uint32_t)carry;
    }
    trim(z);
}

static int compare_magnitudes(const whole *a, const whole *b)
{
    if (a->n != b->n)
        return a->n < b->n ? -1 : 1;
    for (int i = a->n; i-- > 0;)
        if (a->limb[i] != b->limb[i])
            return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

/* z = a + sign b; z may be a. */
static void add(whole *z, const whole *a, const whole *b, int sign)
{
    const int other = sign * b->sign;
    const int same = a->sign == other || a->sign == 0 || other == 0;
    const int swap = !same && compare_magnitudes(a, b) < 0;
    const whole big = swap ? *b : *a, *small = swap ? a : b;
    const whole little = *small;
    const int sum_sign = swap || big.sign == 0 ? other : big.sign;
    const int n = big.n > little.n ? big.n : little.n;
    int64_t carry = 0;
    for (int i = 0; i < n; ++i) {
        const int64_t x = i < big.n ? big.limb[i] : 0, y = i < little.n ? little.limb[i] : 0;
        const int64_t sum = x + (same ? y : -y) + carry;
        z->limb[i] = (uint32_t)((uint64_t)sum & UINT32_MAX);
        carry = sum < 0 ? -1 : sum >> 32;
    }
    z->limb[n] = carry > 0 ? 1 : 0;
    z->n = n + 1;
    z->sign = sum_sign;
    trim(z);
}

/* Divides the nine differences by the highest power of 2^32 that divides all of them. */
static void shorten(whole rows[3][3])
{
    int shared = LIMBS;
    for (int i = 0; i < 9; ++i) {
        const whole *z = &rows[i / 3][i % 3];
        int zeros = 0;
        while (zeros < z->n && z->limb[zeros] == 0)
            ++zeros;
        if (z->n > 0 && zeros < shared)
            shared = zeros;
    }
    for (int i = 0; i < 9; ++i) {
        whole *z = &rows[i / 3][i % 3];
        if (z->n == 0)
            continue;
        z->n -= shared;
        memmove(z->limb, z->limb + shared, (size_t)z->n * sizeof *z->limb);
    }
}

int iccp_fixed_orient3d(const iccp_fixed *a, const iccp_fixed *b, const iccp_fixed *c,
                        const iccp_fixed *d)
{
    const iccp_fixed *const points[3] = {b, a, c};
    whole rows[3][3], left, right, term, det = {0};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            subtract(&rows[i][k], points[i]->limb[k], d->limb[k]);
    shorten(rows);
    for (int i = 0; i < 3; ++i) {
        const whole *p = rows[(i + 1) % 3], *q = rows[(i + 2) % 3];
        multiply(&left, &p[0], &q[1]);
        multiply(&right, &p[1], &q[0]);
        add(&left, &left, &right, -1);
        multiply(&term, &left, &rows[i][2]);
        add(&det, &det, &term, 1);
    }
    return det.sign;
}
