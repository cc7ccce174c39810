/* The frame loses nothing: every sign and every difference is that of the caller's coordinates. */
#include "geometry/frame.h"
#include "math/predicates.h"

#include "../../random.h"
#include "../../suite.h"

#include <check.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { N = 16 };

static random_source source = {1};

static int64_t between(int64_t low, int64_t high)
{
    return low + (int64_t)(random_bits(&source) % (uint64_t)(high - low + 1));
}

static double largest_local(const iccp_frame *frame, size_t n, const double *points, double *local)
{
    double largest = 0;
    for (size_t i = 0; i < n; ++i) {
        iccp_frame_in(frame, 2, points + 2 * i, local + 2 * i);
        largest = fmax(largest, fmax(fabs(local[2 * i]), fabs(local[2 * i + 1])));
    }
    return largest;
}

static int exact_turn(const int64_t *a, const int64_t *b, const int64_t *c)
{
    const int64_t det = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return (det > 0) - (det < 0);
}

/* Integer points at an integer offset, times a power of two, so that everything can be checked in
 * integers. */
static void check_integers(int64_t span, const int64_t offset[2], int exponent)
{
    int64_t grid[2 * N];
    double points[2 * N], local[2 * N], back[2];
    for (int i = 0; i < 2 * N; ++i) {
        grid[i] = between(0, span);
        points[i] = ldexp((double)(grid[i] + offset[i % 2]), exponent);
    }
    iccp_frame frame;
    iccp_frame_fit(&frame, 2, N, points);
    const double largest = largest_local(&frame, N, points, local);
    ck_assert(largest == 0 || (largest >= 0.5 && largest <= 1));
    for (int i = 0; i < N; ++i) {
        ck_assert(iccp_frame_holds(&frame, 2, points + 2 * i));
        iccp_frame_out(&frame, 2, local + 2 * i, back);
        ck_assert(back[0] == points[2 * i] && back[1] == points[2 * i + 1]);
        for (int k = 0; k < 2; ++k) {
            const double unit = ldexp(1, exponent) * frame.in[0] * frame.in[1];
            ck_assert(local[2 * i + k] - local[k] == (double)(grid[2 * i + k] - grid[k]) * unit);
        }
    }
    for (int i = 0; i + 2 < N; ++i)
        ck_assert(iccp_orient2d(local + 2 * i, local + 2 * i + 2, local + 2 * i + 4) ==
                  exact_turn(grid + 2 * i, grid + 2 * i + 2, grid + 2 * i + 4));
}

START_TEST(test_exact)
{
    static const int64_t offsets[] = {0,       1,          -1,        10,         1000,
                                      -100000, 1000000000, -20000003, 1000000007, (int64_t)1 << 40};
    enum { OFFSETS = sizeof offsets / sizeof offsets[0] };
    for (int exponent = -1074; exponent <= 960; exponent += 226)
        for (int i = 0; i < OFFSETS; ++i)
            for (int j = 0; j < OFFSETS; ++j) {
                const int64_t offset[2] = {offsets[i], offsets[j]};
                check_integers(1 + (int64_t)(random_bits(&source) % 8), offset, exponent);
                check_integers(1 << 20, offset, exponent);
            }
}
END_TEST

/* Doubles with all their bits, on both sides of the ratio up to which an axis is shifted. */
START_TEST(test_shift)
{
    int n_shifted = 0;
    for (int round = 0; round < 20000; ++round) {
        const double sign = random_bits(&source) % 2 == 0 ? 1 : -1,
                     ratio = 1 + 3 * random_unit(&source);
        const double lowest = sign * (1 + random_unit(&source));
        double points[2 * N], local[2 * N], back[2];
        double low = HUGE_VAL, high = 0;
        for (int i = 0; i < 2 * N; ++i) {
            points[i] = lowest * (1 + (ratio - 1) * random_unit(&source));
            if (i % 2 == 0) {
                low = fmin(low, fabs(points[i]));
                high = fmax(high, fabs(points[i]));
            }
        }
        iccp_frame frame;
        iccp_frame_fit(&frame, 2, N, points);
        (void)largest_local(&frame, N, points, local);
        ck_assert(frame.shift[0] == (high <= 2 * low ? sign * low : 0));
        n_shifted += high <= 2 * low;
        for (int i = 0; i < N; ++i) {
            iccp_frame_out(&frame, 2, local + 2 * i, back);
            ck_assert(back[0] == points[2 * i] && back[1] == points[2 * i + 1]);
        }
    }
    ck_assert(n_shifted > 4000 && n_shifted < 16000);
}
END_TEST

START_TEST(test_extremes)
{
    static const double cases[][6] = {
        {1e300, 1e300, -1e300, 1e300, 0, -1e300},
        {1.7e308, -1.7e308, -1.7e308, 1e292, 1e300, 1.7e308},
        {1e-310, 0, 3e-310, 0, 0, 2e-310},
        {5e-324, 0, 1e-323, 5e-324, 0, 0},
        {1e15, 1e15, 1e15 + 10, 1e15, 1e15 + 0.125, 1e15 + 7},
        {-1e9, 1e9, -1e9 - 3, 1e9 + 1e-7, -1e9 - 1, 1e9 + 5},
        {1, 1, 1, 1, 1, 1},
        {0, 0, 0, 0, 0, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        iccp_frame frame;
        double local[6], back[2];
        iccp_frame_fit(&frame, 2, 3, cases[i]);
        const double largest = largest_local(&frame, 3, cases[i], local);
        ck_assert(largest == 0 || (largest >= 0.5 && largest <= 1));
        for (size_t k = 0; k < 3; ++k) {
            ck_assert(iccp_frame_holds(&frame, 2, cases[i] + 2 * k));
            iccp_frame_out(&frame, 2, local + 2 * k, back);
            ck_assert(back[0] == cases[i][2 * k] && back[1] == cases[i][2 * k + 1]);
        }
    }
}
END_TEST

/* Vertices too small beside the largest are distinguished from those that are 0 or large enough. */
START_TEST(test_range)
{
    double points[6] = {1e300, 1e300, -1e300, 0, 0, 0};
    static const struct {
        double x;
        bool holds;
    } cases[] = {{0, true},     {1, false},     {1e-310, false}, {5e-324, false}, {1e200, false},
                 {1e245, true}, {-1e245, true}, {-1, false},     {1e299, true},   {-5e-324, false}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        iccp_frame frame;
        points[4] = cases[i].x;
        iccp_frame_fit(&frame, 2, 3, points);
        ck_assert_int_eq(iccp_frame_holds(&frame, 2, points + 4), cases[i].holds);
    }
    ck_assert(ICCP_FRAME_SMALLEST == ldexp(1, -200));
}
END_TEST

START_TEST(test_other_dimensions)
{
    for (int32_t dim = 1; dim <= ICC_MAX_DIM; ++dim) {
        double points[4 * ICC_MAX_DIM], local[ICC_MAX_DIM], back[ICC_MAX_DIM];
        for (int32_t i = 0; i < 4 * dim; ++i)
            points[i] = ldexp((double)between(-1000, 1000), 3) + 1e6 * (i % dim);
        iccp_frame frame;
        iccp_frame_fit(&frame, dim, 4, points);
        double largest = 0;
        for (int32_t i = 0; i < 4; ++i) {
            iccp_frame_in(&frame, dim, points + i * dim, local);
            iccp_frame_out(&frame, dim, local, back);
            for (int32_t k = 0; k < dim; ++k) {
                largest = fmax(largest, fabs(local[k]));
                ck_assert(back[k] == points[i * dim + k]);
            }
        }
        ck_assert(largest >= 0.5 && largest <= 1);
    }
}
END_TEST

/* From frame to frame as by way of the caller's coordinates; between unlike ones as it is. */
START_TEST(test_change)
{
    static const struct {
        double from[4], to[4];
        bool keeps;
    } cases[] = {{{0, 0, 1, 1}, {0, 0, 8, 4}, false},
                 {{3, 3, 4, 5}, {-7, 9, -7.5, 10}, false},
                 {{0, 0, 8e200, 1e199}, {0, 0, 1e200, 1e201}, false},
                 {{1e17, 5, 1e17 + 64, 9}, {1e17 + 64, 5, 1e17 + 128, 9}, false},
                 {{0, 0, 1e300, 1}, {0, 0, 1, 1}, true},
                 {{0, 0, 1, 1}, {0, 0, 33, 1}, true},
                 {{0, 0, 1, 1}, {40, 0, 41, 1}, true},
                 {{0, 0, 1, 1}, {1e17, 1e17, 1e17 + 64, 1e17}, true},
                 {{1.7e308, 0, 1.6e308, 1}, {-1.7e308, 0, -1.6e308, 1}, true},
                 {{0, 0, 1e-320, 0}, {0, 0, 1, 1}, true}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        iccp_frame from, to;
        double local[4], own[2], want[2];
        iccp_frame_fit(&from, 2, 2, cases[i].from);
        iccp_frame_fit(&to, 2, 2, cases[i].to);
        for (size_t k = 0; k < 2; ++k)
            iccp_frame_in(&from, 2, cases[i].from + 2 * k, local + 2 * k);
        iccp_frame_out(&from, 2, local + 2, own);
        iccp_frame_in(&to, 2, own, want);
        if (cases[i].keeps)
            memcpy(want, local + 2, sizeof want);
        iccp_frame_change(&from, &to, 2, 2, local);
        ck_assert_msg(local[2] == want[0] && local[3] == want[1], "case %zu", i);
    }
}
END_TEST

START_TEST(test_identity)
{
    const double x[ICC_MAX_DIM] = {1, -2, 3e300, 0, 5e-324, 6};
    double local[ICC_MAX_DIM], back[ICC_MAX_DIM];
    const iccp_frame identity = iccp_frame_identity();
    iccp_frame_in(&identity, ICC_MAX_DIM, x, local);
    iccp_frame_out(&identity, ICC_MAX_DIM, x, back);
    for (int k = 0; k < ICC_MAX_DIM; ++k)
        ck_assert(local[k] == x[k] && back[k] == x[k]);
}
END_TEST

int main(void)
{
    TCase *frame = tcase_create("frame");
    tcase_add_test(frame, test_exact);
    tcase_add_test(frame, test_shift);
    tcase_add_test(frame, test_extremes);
    tcase_add_test(frame, test_range);
    tcase_add_test(frame, test_other_dimensions);
    tcase_add_test(frame, test_change);
    tcase_add_test(frame, test_identity);
    Suite *suite = suite_create("frame");
    suite_add_tcase(suite, frame);
    return suite_run(suite);
}
