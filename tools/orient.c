/* Based on: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates, 1997: a filter, then the determinant as a sum of exact products.
 *
 * The library has its own, but does not export it, and the command shall also run with the shared
 * library. Speed does not matter here, so one filter and one exact stage do. */
#include "orient.h"

#include <float.h>
#include <math.h>

/* A sum of doubles that do not overlap, smallest first. */
typedef struct expansion {
    double parts[12];
    int n;
} expansion;

/* Adds a number exactly (GROW-EXPANSION with Knuth's two-sum), leaving zeros out. */
static void add(expansion *e, double x)
{
    int n = 0;
    for (int i = 0; i < e->n; i++) {
        double y = e->parts[i], sum = x + y, part = sum - x;
        double rest = (x - (sum - part)) + (y - part);
        if (fpclassify(rest) != FP_ZERO)
            e->parts[n++] = rest;
        x = sum;
    }
    if (fpclassify(x) != FP_ZERO)
        e->parts[n++] = x;
    e->n = n;
}

static void add_product(expansion *e, double x, double y)
{
    double product = x * y;
    add(e, fma(x, y, -product));
    add(e, product);
}

static int exact(const double a[2], const double b[2], const double c[2])
{
    double size = 0, s[6] = {a[0], a[1], b[0], b[1], c[0], c[1]};
    int exponent;
    for (int i = 0; i < 6; i++)
        size = fmax(size, fabs(s[i]));
    /* At 2^500 no product overflows, and the low part of none underflows down to 2^-480. */
    frexp(size, &exponent);
    for (int i = 0; i < 6; i++)
        s[i] = ldexp(s[i], 500 - exponent);
    expansion e = {.n = 0};
    add_product(&e, s[0], s[3]);
    add_product(&e, -s[1], s[2]);
    add_product(&e, s[2], s[5]);
    add_product(&e, -s[3], s[4]);
    add_product(&e, s[4], s[1]);
    add_product(&e, -s[5], s[0]);
    return e.n == 0 ? 0 : e.parts[e.n - 1] > 0 ? 1 : -1;
}

int orientation(const double a[2], const double b[2], const double c[2])
{
    /* (3 + 16 u) u with u = 2^-53, Shewchuk's bound A; it holds while nothing underflows. */
    const double bound = (3 + 8 * DBL_EPSILON) * (DBL_EPSILON / 2), tiny = 1e-280;
    double left = (a[0] - c[0]) * (b[1] - c[1]), right = (a[1] - c[1]) * (b[0] - c[0]);
    double det = left - right, size = fabs(left) + fabs(right);
    if (isfinite(size) && size > tiny && fabs(det) > bound * size)
        return det > 0 ? 1 : -1;
    return exact(a, b, c);
}
