/* Based on: J. R. Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric
 * Predicates, 1997: a filter, then the determinant as a sum of exact products.
 *
 * The library has predicates but does not export them, and the command must also run with the
 * shared library. Speed does not matter here, so one filter and one exact stage are enough. */
#include "base/orientation.h"

#include <float.h>
#include <math.h>

/* A sum of doubles that do not overlap, smallest first. */
typedef struct expansion {
    double parts[96]; /* each number added makes the sum longer by at most one part */
    int n;
} expansion;

/* Adds a number exactly (GROW-EXPANSION with Knuth's two-sum) and drops zeros. */
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

static int sign(const expansion *e)
{
    return e->n == 0 ? 0 : e->parts[e->n - 1] > 0 ? 1 : -1;
}

/* Scales n numbers by a power of two, so that the largest is less than 2^exponent. */
static void scale(double *s, int n, int exponent)
{
    double size = 0;
    int own;
    for (int i = 0; i < n; i++)
        size = fmax(size, fabs(s[i]));
    frexp(size, &own);
    for (int i = 0; i < n; i++)
        s[i] = ldexp(s[i], exponent - own);
}

static int exact(const double a[2], const double b[2], const double c[2])
{
    double s[6] = {a[0], a[1], b[0], b[1], c[0], c[1]};
    /* At 2^500 no product overflows, and the low part of none underflows down to 2^-480. */
    scale(s, 6, 500);
    expansion e = {.n = 0};
    add_product(&e, s[0], s[3]);
    add_product(&e, -s[1], s[2]);
    add_product(&e, s[2], s[5]);
    add_product(&e, -s[3], s[4]);
    add_product(&e, s[4], s[1]);
    add_product(&e, -s[5], s[0]);
    return sign(&e);
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

/* Adds x y z exactly: four numbers. */
static void add_triple(expansion *e, double x, double y, double z)
{
    double product = x * y, rest = fma(x, y, -product);
    add_product(e, rest, z);
    add_product(e, product, z);
}

/* Adds, or with sign -1 subtracts, the determinant of the rows p, q, r: 24 numbers. */
static void add_determinant(expansion *e, double sign_of, const double *p, const double *q,
                            const double *r)
{
    for (int i = 0; i < 3; i++) {
        int k = (i + 1) % 3, l = (i + 2) % 3;
        add_triple(e, sign_of * p[i], q[k], r[l]);
        add_triple(e, -sign_of * p[i], q[l], r[k]);
    }
}

/* The determinant of the rows (1, a) to (1, d). It needs no differences. */
static int exact_3d(const double *points[4])
{
    double s[12];
    for (int i = 0; i < 12; i++)
        s[i] = points[i / 3][i % 3];
    /* At 2^330 no product of three overflows, and no part of one underflows down to 2^-300. */
    scale(s, 12, 330);
    expansion e = {.n = 0};
    add_determinant(&e, 1, s + 3, s + 6, s + 9);
    add_determinant(&e, -1, s, s + 6, s + 9);
    add_determinant(&e, 1, s, s + 3, s + 9);
    add_determinant(&e, -1, s, s + 3, s + 6);
    return sign(&e);
}

int orientation_3d(const double a[3], const double b[3], const double c[3], const double d[3])
{
    /* (7 + 56 u) u with u = 2^-53, Shewchuk's bound A, and what may be lost of six products that
     * underflow by 2^-1075 each. */
    const double bound = (7 + 28 * DBL_EPSILON) * (DBL_EPSILON / 2), underflow = 1e-322;
    double p[3], q[3], r[3], det = 0, size = 0, longest = 1;
    for (int i = 0; i < 3; i++) {
        p[i] = b[i] - a[i];
        q[i] = c[i] - a[i];
        r[i] = d[i] - a[i];
    }
    for (int i = 0; i < 3; i++) {
        int k = (i + 1) % 3, l = (i + 2) % 3;
        double left = q[k] * r[l], right = q[l] * r[k];
        det += p[i] * (left - right);
        size += fabs(p[i]) * (fabs(left) + fabs(right));
        longest = fmax(longest, fabs(p[i]));
    }
    if (isfinite(size) && fabs(det) > bound * size + underflow * longest)
        return det > 0 ? 1 : -1;
    return exact_3d((const double *[4]){a, b, c, d});
}
