/* The two triangular solves on numbers beyond the range of double. While they run, a number is
 * x * 2^(512 e): neighbours nearly always share e, so that most multiply-adds are those of plain
 * numbers, and a number is normalised, 2^-256 <= |x| < 2^256, only once per solve. That leaves room
 * for entries of the factor from 2^-500 to 2^500. Where two numbers are added, what lies 2 or more
 * units e lower is below 2^-512 of the other one: it is dropped. */
#include "math/ldlt.h"

enum { UNIT = 512, MAX_STEPS = 4 };

#define UNIT_UP 0x1p512
#define UNIT_DOWN 0x1p-512
#define HIGH 0x1p256
#define LOW 0x1p-256

/* Entries so large that they do not fit after MAX_STEPS are not finite. */
static ICCP_INLINE void normalise(double *x, int32_t *e)
{
    if (ICCP_LIKELY(fabs(*x) >= LOW && fabs(*x) < HIGH))
        return;
    if (!(*x < 0 || *x > 0)) {
        *e = ICCP_ZERO_EXPONENT;
        return;
    }
    for (int k = 0; k < MAX_STEPS && fabs(*x) >= HIGH; ++k, ++*e)
        *x *= UNIT_DOWN;
    for (int k = 0; k < MAX_STEPS && fabs(*x) < LOW; ++k, --*e)
        *x *= UNIT_UP;
}

/* (x, e) -= (term, unit). */
static ICCP_INLINE void subtract(double *x, int32_t *e, double term, int32_t unit)
{
    if (ICCP_LIKELY(unit == *e)) {
        *x -= term;
    } else if (unit < *e) {
        if (unit == *e - 1)
            *x -= term * UNIT_DOWN;
    } else {
        *x = (unit == *e + 1 ? *x * UNIT_DOWN : 0.0) - term;
        *e = unit;
    }
}

/* The right side in eliminated numbering and in units of 2^512. */
static void gather(const iccp_ldlt *l, const iccp_scaled *b, const iccp_scaled *work)
{
    for (size_t k = 0; k < l->n; ++k) {
        const size_t row = l->order[k];
        const int32_t exponent = b->exponent[row];
        if (exponent == ICCP_ZERO_EXPONENT) {
            work->fraction[k] = 0;
            work->exponent[k] = ICCP_ZERO_EXPONENT;
            continue;
        }
        const int32_t rest = (exponent + UNIT / 2) & (UNIT - 1);
        work->fraction[k] = ldexp(b->fraction[row], rest - UNIT / 2);
        work->exponent[k] = (exponent + UNIT / 2 - rest) / UNIT;
    }
}

static void scatter(const iccp_ldlt *l, const iccp_scaled *b, const iccp_scaled *work)
{
    for (size_t k = 0; k < l->n; ++k)
        iccp_scaled_set(b, l->order[k], work->fraction[k],
                        work->fraction[k] < 0 || work->fraction[k] > 0 ? work->exponent[k] * UNIT : 0);
}

void iccp_ldlt_solve_scaled(const iccp_ldlt *factor, const iccp_scaled *b, const iccp_scaled *work)
{
    const size_t n = factor->n;
    double *x = work->fraction;
    int32_t *e = work->exponent;
    gather(factor, b, work);
    for (size_t k = 0; k < n; ++k) {
        normalise(&x[k], &e[k]);
        if (e[k] == ICCP_ZERO_EXPONENT)
            continue;
        for (size_t p = factor->first[k]; p < factor->first[k + 1]; ++p)
            subtract(&x[factor->row[p]], &e[factor->row[p]], factor->value[p] * x[k], e[k]);
    }
    for (size_t k = n; k-- > 0;) {
        double sum = x[k] / factor->pivot[k];
        int32_t unit = e[k];
        for (size_t p = factor->first[k]; p < factor->first[k + 1]; ++p)
            subtract(&sum, &unit, factor->value[p] * x[factor->row[p]], e[factor->row[p]]);
        normalise(&sum, &unit);
        x[k] = sum;
        e[k] = unit;
    }
    scatter(factor, b, work);
}
