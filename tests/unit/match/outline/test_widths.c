/* Widths of outlines: what a pairing does to them. */
#include "base/env.h"
#include "match/outline/widths.h"

#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

enum { N = ICCP_MATCH_SAMPLES };

static iccp_widths widths;
static float place[N];

/* A bar of length 4 and another one, larger and turned. */
static void measure(double width, double scale)
{
    const double c = scale * cos(.7), s = scale * sin(.7), w[2] = {1, width};
    static const uint32_t edges[] = {0, 1, 1, 2, 2, 3, 3, 0};
    iccp_outline outline[2] = {0};
    icc_domain *domain[2];
    for (int side = 0; side < 2; ++side) {
        double xy[8] = {0, 0, 4, 0, 4, w[side], 0, w[side]};
        for (int k = 0; k < 4 && side == 1; ++k) {
            const double x = xy[2 * k], y = xy[2 * k + 1];
            xy[2 * k] = c * x - s * y;
            xy[2 * k + 1] = s * x + c * y;
        }
        const iccp_memory memory = iccp_memory_default;
        ck_assert_int_eq(icc_domain_create(&domain[side], 2, 4, xy, 4, edges, NULL, NULL), ICC_OK);
        ck_assert_int_eq(iccp_outline_create(&outline[side], domain[side], &memory, NULL), ICC_OK);
    }
    iccp_widths_measure(&widths, &outline[0], &outline[1]);
    for (int side = 0; side < 2; ++side) {
        const iccp_memory memory = iccp_memory_default;
        iccp_outline_free(&outline[side], &memory);
        icc_domain_free(domain[side]);
    }
}

/* What is opposite a place on a long side is on the other one, but for corners. */
START_TEST(widths_are_those_of_a_bar)
{
    measure(1, 1);
    for (int k = 0; k < N; ++k) {
        const double at = 10.0 * k / N;
        if (at > 1 && at < 3)
            ck_assert_double_lt(fabs(10.0 * widths.across[0][k] / N - (9 - at)), 20.0 / N);
    }
}
END_TEST

/* Larger, turned, or begun elsewhere by whole turns is no change. */
START_TEST(larger_is_not_uneven)
{
    const double scales[] = {1, 37, 1e-4};
    for (size_t k = 0; k < sizeof scales / sizeof *scales; ++k)
        for (int turn = -1; turn < 2; ++turn) {
            measure(1, scales[k]);
            for (int i = 0; i < N; ++i)
                place[i] = (float)(i + turn * N);
            ck_assert_double_lt(iccp_widths_change(&widths, place), 1e-9);
        }
}
END_TEST

/* One side paired farther and farther along the other's: more and more uneven. */
START_TEST(what_is_shifted_along_one_side_is_uneven)
{
    double before = 0;
    measure(1, 1);
    for (int shift = 1; shift < 6; ++shift) {
        for (int i = 0; i < N; ++i) {
            const double at = (double)i / N;
            place[i] =
                (float)(i +
                        (at > .05 && at < .35 ? 8 * shift * sin((at - .05) / .3 * 3.14159) : 0));
        }
        const double now = iccp_widths_change(&widths, place);
        ck_assert_double_gt(now, before);
        before = now;
    }
    ck_assert_double_gt(before, .01);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("widths");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, widths_are_those_of_a_bar);
    tcase_add_test(tests, larger_is_not_uneven);
    tcase_add_test(tests, what_is_shifted_along_one_side_is_uneven);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
