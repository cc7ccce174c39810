/* The exact predicates against GMP's rationals on inputs made to be degenerate or nearly so. */
#include "../../random.h"
#include "../../share.h"
#include "../../suite.h"
#include "math/expansion.h"
#include "math/predicates.h"

#include <check.h>
#include <gmp.h>
#include <stdint.h>
#include <stdlib.h>

enum { N = 100000 };

/* What the predicates do not promise to get right becomes zero. */
static double in_range(double a)
{
    return fabs(a) < 0x1p-200 || fabs(a) > 0x1p200 ? 0.0 : a;
}

/* The next double above or below, or the same. */
static double nudge(double a, int direction)
{
    return in_range(direction == 0 ? a : nextafter(a, direction * HUGE_VAL));
}

/* Room for the rationals of one evaluation. */
typedef struct exact {
    mpq_t x[9], m[3], sum, t;
} exact;

static void exact_init(exact *q)
{
    for (int i = 0; i < 9; ++i)
        mpq_init(q->x[i]);
    for (int i = 0; i < 3; ++i)
        mpq_init(q->m[i]);
    mpq_init(q->sum);
    mpq_init(q->t);
}

static void exact_clear(exact *q)
{
    for (int i = 0; i < 9; ++i)
        mpq_clear(q->x[i]);
    for (int i = 0; i < 3; ++i)
        mpq_clear(q->m[i]);
    mpq_clear(q->sum);
    mpq_clear(q->t);
}

/* out = a - b. */
static void difference(exact *q, mpq_t out, double a, double b)
{
    mpq_set_d(out, a);
    mpq_set_d(q->t, b);
    mpq_sub(out, out, q->t);
}

/* out = a b - c d. */
static void cross(exact *q, mpq_t out, mpq_t a, mpq_t b, mpq_t c, mpq_t d)
{
    mpq_mul(out, a, b);
    mpq_mul(q->t, c, d);
    mpq_sub(out, out, q->t);
}

static int exact_cross_sign(exact *q, const double v[8])
{
    for (int i = 0; i < 4; ++i)
        difference(q, q->x[i], v[2 * i], v[2 * i + 1]);
    cross(q, q->sum, q->x[0], q->x[1], q->x[2], q->x[3]);
    return mpq_sgn(q->sum);
}

static int exact_orient(exact *q, const double *a, const double *b, const double *c)
{
    const double v[8] = {a[0], c[0], b[1], c[1], a[1], c[1], b[0], c[0]};
    return exact_cross_sign(q, v);
}

static int exact_incircle(exact *q, double p[4][2])
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
            difference(q, q->x[2 * i + k], p[i][k], p[3][k]);
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        cross(q, q->m[i], q->x[2 * j], q->x[2 * k + 1], q->x[2 * k], q->x[2 * j + 1]);
    }
    mpq_set_ui(q->sum, 0, 1);
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k) {
            mpq_mul(q->t, q->x[2 * i + k], q->x[2 * i + k]);
            mpq_mul(q->t, q->t, q->m[i]);
            mpq_add(q->sum, q->sum, q->t);
        }
    return mpq_sgn(q->sum);
}

static int exact_orient3d(exact *q, double p[4][3])
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            difference(q, q->x[3 * i + k], p[i + 1][k], p[0][k]);
    mpq_set_ui(q->sum, 0, 1);
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        cross(q, q->m[0], q->x[3 + i], q->x[6 + j], q->x[3 + j], q->x[6 + i]);
        mpq_mul(q->m[0], q->m[0], q->x[k]);
        mpq_add(q->sum, q->sum, q->m[0]);
    }
    return mpq_sgn(q->sum);
}

static int cross_sign(const double v[8])
{
    return iccp_cross_sign(v[0], v[1], v[2], v[3], v[4], v[5], v[6], v[7]);
}

/* A magnitude that is zero now and then, otherwise anywhere in the permitted range or near 1. */
static double any(random_source *r)
{
    const double sign = random_bits(r) & 1 ? -1.0 : 1.0;
    switch (random_below(r, 6)) {
    case 0:
        return 0.0;
    case 1:
        return sign * 0x1p-200;
    case 2:
        return sign * 0x1p200;
    case 3:
        return sign * random_unit(r) + sign;
    case 4:
        return ldexp(sign, random_below(r, 401) - 200);
    default:
        return sign * ldexp(1.0 + random_unit(r), random_below(r, 400) - 200);
    }
}

static double grid(random_source *r, int cells)
{
    return random_below(r, 2 * cells + 1) - cells;
}

/* Three points on a line through the plane or a few units in the last place beside it. */
static void nearly_collinear(random_source *r, double p[3][2])
{
    const double scale = ldexp(1.0, random_below(r, 100) - 50), offset = random_below(r, 3) * 12.0;
    const double dx = random_unit(r) * scale, dy = random_unit(r) * scale;
    for (int i = 0; i < 3; ++i) {
        const double s = random_below(r, 2) ? random_unit(r) : grid(r, 8) / 8.0;
        p[i][0] = nudge(offset + s * dx, random_below(r, 3) - 1);
        p[i][1] = nudge(offset + s * dy, random_below(r, 3) - 1);
    }
}

/* The classic: three points whose last bits decide, around the line y = x. */
static void last_bits(random_source *r, double p[3][2])
{
    const double corner[3] = {0.5, 12.0, 24.0};
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
            p[i][k] = corner[i] + (i == 0 ? random_below(r, 256) * 0x1p-53 : 0.0);
}

static void spread(random_source *r, double p[3][2])
{
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 2; ++k)
            p[i][k] = any(r);
    if (random_bits(r) & 1) {
        p[2][0] = in_range(p[0][0] + p[1][0]);
        p[2][1] = in_range(p[0][1] + p[1][1]);
    }
}

static void check_orientation(exact *q, double p[3][2])
{
    const int s = exact_orient(q, p[0], p[1], p[2]);
    ck_assert_int_eq(iccp_orient2d(p[0], p[1], p[2]), s);
    ck_assert_int_eq(iccp_orient2d(p[1], p[2], p[0]), s);
    ck_assert_int_eq(iccp_orient2d(p[2], p[0], p[1]), s);
    ck_assert_int_eq(iccp_orient2d(p[1], p[0], p[2]), -s);
    ck_assert_int_eq(iccp_orient2d(p[0], p[2], p[1]), -s);
    ck_assert_int_eq(iccp_orient2d(p[2], p[1], p[0]), -s);
}

START_TEST(orientation_is_exact)
{
    exact q;
    exact_init(&q);
    random_source r = {1};
    int n_zero = 0;
    for (int i = 0; i < share_of(N); ++i) {
        double p[3][2];
        void (*const make[3])(random_source *, double[3][2]) = {nearly_collinear, last_bits,
                                                                spread};
        make[i % 3](&r, p);
        check_orientation(&q, p);
        n_zero += iccp_orient2d(p[0], p[1], p[2]) == 0;
    }
    /* The inputs are what they claim to be: many degenerate, many not. */
    ck_assert_int_gt(n_zero, share_of(N) / 100);
    ck_assert_int_lt(n_zero, share_of(N) / 2);
    exact_clear(&q);
}
END_TEST

/* Two factors on either side that are equal, or swapped, or nearly so. */
static void make_cross(random_source *r, double v[8])
{
    for (int i = 0; i < 8; ++i)
        v[i] = i % 4 < 2 ? any(r) : random_unit(r);
    const int kind = random_below(r, 4);
    if (kind == 0)
        return;
    for (int i = 0; i < 4; ++i)
        v[4 + i] = kind == 1 ? v[i] : kind == 2 ? v[(i + 2) % 4] : v[3 - i];
    const int i = random_below(r, 8);
    v[i] = v[i] == 0.0 ? 0x1p-200 : nudge(v[i], random_below(r, 3) - 1);
}

START_TEST(cross_sign_is_exact)
{
    exact q;
    exact_init(&q);
    random_source r = {2};
    int n_zero = 0;
    for (int i = 0; i < share_of(N); ++i) {
        double v[8];
        make_cross(&r, v);
        const int s = exact_cross_sign(&q, v);
        const double swapped[8] = {v[4], v[5], v[6], v[7], v[0], v[1], v[2], v[3]};
        ck_assert_int_eq(cross_sign(v), s);
        ck_assert_int_eq(cross_sign(swapped), -s);
        n_zero += s == 0;
    }
    ck_assert_int_gt(n_zero, share_of(N) / 100);
    ck_assert_int_lt(n_zero, share_of(N) / 2);
    exact_clear(&q);
}
END_TEST

/* Four points on a circle round a grid point, moved off it by at most one unit in the last place,
 * and sometimes shifted so far that the differences are rounded. */
static void nearly_cocircular(random_source *r, double p[4][2])
{
    static const double corner[4][2] = {{33, 56}, {16, 63}, {39, 52}, {25, 60}}; /* radius 65 */
    const double scale = ldexp(random_below(r, 2) ? 1.0 : 0.1, random_below(r, 80) - 40);
    const double centre[2] = {grid(r, 9) * scale, grid(r, 9) * scale};
    for (int i = 0; i < 4; ++i) {
        const double *c = corner[random_below(r, 4)];
        const int swap = random_below(r, 2);
        for (int k = 0; k < 2; ++k) {
            const double sign = random_below(r, 2) ? 1.0 : -1.0;
            p[i][k] = centre[k] + scale * sign * c[k ^ swap];
            if (random_below(r, 4) == 0)
                p[i][k] = nudge(p[i][k], random_below(r, 3) - 1);
        }
    }
}

static void small_lattice(random_source *r, double p[4][2])
{
    const double scale =
        ldexp(1.0, random_below(r, 300) - 150) * (random_below(r, 2) ? 1.0 : 1.0 / 3.0);
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 2; ++k)
            p[i][k] = scale * grid(r, 3);
}

/* Integers of 6 to 16 bits, at most one off the circle round the origin. */
static void integers(random_source *r, double p[4][2])
{
    static const double corner[4][2] = {{33, 56}, {16, 63}, {39, 52}, {25, 60}}; /* radius 65 */
    const double factor = (double)(1 + random_below(r, 1 << random_below(r, 11)));
    for (int i = 0; i < 4; ++i) {
        const int which = random_below(r, 4), swap = random_below(r, 2);
        for (int k = 0; k < 2; ++k) {
            const double sign = random_below(r, 2) ? 1.0 : -1.0;
            const double off = random_below(r, 8) == 0 ? 1.0 : 0.0;
            p[i][k] = sign * (factor * corner[which][k ^ swap] + off);
        }
    }
}

/* On one circle in exact arithmetic whatever the magnitudes: the corners of a rectangle. */
static void rectangle(random_source *r, double p[4][2])
{
    const double x[2] = {any(r), any(r)}, y[2] = {any(r), any(r)};
    for (int i = 0; i < 4; ++i) {
        p[i][0] = x[i == 1 || i == 2];
        p[i][1] = y[i >= 2];
    }
    if (random_bits(r) & 1) {
        const int i = random_below(r, 4), k = random_below(r, 2);
        p[i][k] = p[i][k] == 0.0 ? 0x1p-200 : in_range(p[i][k] * (1.0 - 0x1p-52));
    }
}

static void wild(random_source *r, double p[4][2])
{
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 2; ++k)
            p[i][k] = any(r);
}

/* Every order of the four points; the sign is that of the permutation. */
static void check_all_orders(double p[4][2], int s)
{
    for (int code = 0; code < 256; ++code) {
        const int i[4] = {code & 3, code >> 2 & 3, code >> 4 & 3, code >> 6};
        int parity = 1, distinct = 1;
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) {
                parity = i[a] > i[b] ? -parity : parity;
                distinct = distinct && i[a] != i[b];
            }
        if (distinct)
            ck_assert_int_eq(iccp_incircle(p[i[0]], p[i[1]], p[i[2]], p[i[3]]), parity * s);
    }
}

START_TEST(incircle_is_exact)
{
    exact q;
    exact_init(&q);
    random_source r = {3};
    int n_zero = 0;
    for (int i = 0; i < share_of(N); ++i) {
        double p[4][2];
        void (*const make[5])(random_source *, double[4][2]) = {nearly_cocircular, small_lattice,
                                                                integers, rectangle, wild};
        make[i % 5](&r, p);
        const int s = exact_incircle(&q, p);
        ck_assert_int_eq(iccp_incircle(p[0], p[1], p[2], p[3]), s);
        if (i % 20 < 5)
            check_all_orders(p, s);
        n_zero += s == 0;
    }
    ck_assert_int_gt(n_zero, share_of(N) / 100);
    ck_assert_int_lt(n_zero, share_of(N) * 3 / 4);
    exact_clear(&q);
}
END_TEST

/* Four points of a plane through a random frame, or a few units in the last place beside it. */
static void nearly_coplanar(random_source *r, double p[4][3])
{
    const double scale = ldexp(1.0, random_below(r, 100) - 50), offset = random_below(r, 3) * 12.0;
    double u[3], v[3];
    for (int k = 0; k < 3; ++k) {
        u[k] = random_unit(r) * scale;
        v[k] = random_unit(r) * scale;
    }
    for (int i = 0; i < 4; ++i) {
        const int coarse = random_below(r, 2);
        const double s = coarse ? grid(r, 8) / 8.0 : random_unit(r);
        const double t = coarse ? grid(r, 8) / 8.0 : random_unit(r);
        for (int k = 0; k < 3; ++k)
            p[i][k] = nudge(offset + s * u[k] + t * v[k], random_below(r, 3) - 1);
    }
}

/* Corners of a parallelogram: coplanar in exact arithmetic, of all magnitudes. */
static void parallelogram(random_source *r, double p[4][3])
{
    for (int k = 0; k < 3; ++k) {
        const double x[2] = {any(r), any(r)};
        const int level = random_below(r, 3);
        for (int i = 0; i < 4; ++i)
            p[i][k] = x[level == 0 ? i & 1 : level == 1 ? i >> 1 : 0];
    }
    if (random_bits(r) & 1) {
        const int i = random_below(r, 4), k = random_below(r, 3);
        p[i][k] = p[i][k] == 0.0 ? 0x1p-200 : in_range(p[i][k] * (1.0 - 0x1p-52));
    }
}

static void lattice3(random_source *r, double p[4][3])
{
    const int cells = 1 << random_below(r, 18);
    const double scale = ldexp(random_below(r, 2) ? 1.0 : 1.0 / 3.0, random_below(r, 300) - 150);
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i)
            p[i][k] = scale * grid(r, cells);
        p[3][k] = in_range(p[0][k] + p[1][k] - p[2][k]);
    }
}

static void wild3(random_source *r, double p[4][3])
{
    for (int i = 0; i < 4; ++i)
        for (int k = 0; k < 3; ++k)
            p[i][k] = any(r);
}

START_TEST(orientation_in_space_is_exact)
{
    exact q;
    exact_init(&q);
    random_source r = {5};
    int n_zero = 0;
    for (int i = 0; i < share_of(N); ++i) {
        double p[4][3];
        void (*const make[4])(random_source *, double[4][3]) = {nearly_coplanar, parallelogram,
                                                                lattice3, wild3};
        make[i % 4](&r, p);
        const int s = exact_orient3d(&q, p);
        ck_assert_int_eq(iccp_orient3d(p[0], p[1], p[2], p[3]), s);
        ck_assert_int_eq(iccp_orient3d(p[1], p[0], p[2], p[3]), -s);
        ck_assert_int_eq(iccp_orient3d(p[0], p[1], p[3], p[2]), -s);
        ck_assert_int_eq(iccp_orient3d(p[1], p[2], p[3], p[0]), -s);
        ck_assert_int_eq(iccp_orient3d(p[2], p[3], p[0], p[1]), s);
        n_zero += s == 0;
    }
    ck_assert_int_gt(n_zero, share_of(N) / 20);
    ck_assert_int_lt(n_zero, share_of(N) * 3 / 4);
    exact_clear(&q);
}
END_TEST

START_TEST(signs_mean_what_the_header_says)
{
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, y[3] = {0, 1, 0}, z[3] = {0, 0, 1};
    ck_assert_int_eq(iccp_orient3d(o, x, y, z), 1);
    const double a[2] = {0, 0}, b[2] = {1, 0}, c[2] = {0, 1};
    const double in[2] = {0.5, 0.5}, on[2] = {1, 1}, out[2] = {1, 1 + 0x1p-52};
    ck_assert_int_eq(iccp_orient2d(a, b, c), 1);
    ck_assert_int_eq(iccp_incircle(a, b, c, in), 1);
    ck_assert_int_eq(iccp_incircle(a, b, c, on), 0);
    ck_assert_int_eq(iccp_incircle(a, b, c, out), -1);
    ck_assert_int_eq(iccp_cross_sign(3, 1, 3, 1, 2, 1, 2, 1), 1);
}
END_TEST

static double value(mpq_t sum, size_t n, const double *e)
{
    mpq_t t;
    mpq_init(t);
    mpq_set_ui(sum, 0, 1);
    for (size_t i = 0; i < n; ++i) {
        mpq_set_d(t, e[i]);
        mpq_add(sum, sum, t);
    }
    mpq_clear(t);
    return mpq_get_d(sum);
}

START_TEST(expansions_keep_their_value)
{
    random_source r = {4};
    mpq_t a, b, c;
    mpq_init(a);
    mpq_init(b);
    mpq_init(c);
    for (int i = 0; i < share_of(N) / 10; ++i) {
        double e[4], f[4], sum[8], scaled[16];
        const size_t m =
            iccp_expansion_cross(e, random_unit(&r), random_unit(&r), any(&r), random_unit(&r));
        const size_t n =
            iccp_expansion_cross(f, any(&r), random_unit(&r), random_unit(&r), random_unit(&r));
        const double factor = random_unit(&r);
        const size_t n_sum = iccp_expansion_sum(sum, m, e, n, f);
        const size_t n_scaled = iccp_expansion_scale(scaled, n_sum, sum, factor);
        for (size_t k = 0; k + 1 < n_sum; ++k)
            ck_assert(sum[k] != 0.0 && fabs(sum[k]) < fabs(sum[k + 1]));
        value(a, m, e);
        value(b, n, f);
        mpq_add(a, a, b);
        value(c, n_sum, sum);
        ck_assert(mpq_equal(a, c));
        mpq_set_d(b, factor);
        mpq_mul(a, a, b);
        value(c, n_scaled, scaled);
        ck_assert(mpq_equal(a, c));
        ck_assert_int_eq(iccp_expansion_sign(n_scaled, scaled), mpq_sgn(a));
    }
    mpq_clear(a);
    mpq_clear(b);
    mpq_clear(c);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("predicates");
    TCase *tests = tcase_create("exact");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, signs_mean_what_the_header_says);
    tcase_add_test(tests, expansions_keep_their_value);
    tcase_add_test(tests, orientation_is_exact);
    tcase_add_test(tests, cross_sign_is_exact);
    tcase_add_test(tests, incircle_is_exact);
    tcase_add_test(tests, orientation_in_space_is_exact);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
