/* Paths between landmarks of two surfaces, short ones and even ones. */
#include "../../../suite.h"
#include "../../../surfaces.h"
#include "base/env.h"
#include "match/sphere/landmark_paths.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

enum { N = 10, PATHS = 3 * N - 6, TRIALS = 40, SPLITS = 3 };

static surface one, two;

typedef struct web {
    uint32_t ends[PATHS][2];
    iccp_paths_report report;
} web;

static icc_status lay(web *w, const uint32_t at[N], bool is_even, double most_ratio)
{
    const iccp_env env = {.memory = iccp_memory_default};
    const surface *const surfaces[2] = {&one, &two};
    const uint32_t *const vertices[2] = {at, at};
    uint8_t joined[N * N];
    iccp_half_edges m[2];
    iccp_split_surface s[2];
    for (int side = 0; side < 2; ++side) {
        const surface *const from = surfaces[side];
        ck_assert_int_eq(iccp_half_edges_create(&m[side], from->n_vertices, from->n_faces,
                                                from->faces, &env, NULL),
                         ICC_OK);
        ck_assert(iccp_split_surface_create(&s[side], &m[side], from->vertices, &env.memory));
    }
    const icc_status status =
        iccp_landmark_paths(s, N, vertices, (const double[]){1, 1}, 0, is_even, most_ratio, w->ends,
                            joined, &w->report, &env);
    for (uint32_t a = 0; a < N && status == ICC_OK; ++a)
        for (uint32_t b = 0; b < N; ++b) {
            size_t n = 0;
            for (size_t k = 0; k < PATHS; ++k)
                n += (w->ends[k][0] == a && w->ends[k][1] == b) ||
                     (w->ends[k][0] == b && w->ends[k][1] == a);
            ck_assert_uint_eq(n, joined[N * a + b]);
        }
    for (int side = 0; side < 2; ++side) {
        iccp_split_surface_free(&s[side]);
        iccp_half_edges_free(&m[side]);
    }
    return status;
}

static void draw_landmarks(uint32_t at[N], random_source *r)
{
    for (size_t k = 0; k < N; ++k) {
        bool is_new = false;
        while (!is_new) {
            at[k] = (uint32_t)random_below(r, (int)one.n_vertices);
            is_new = true;
            for (size_t i = 0; i < k; ++i)
                is_new = is_new && at[i] != at[k];
        }
    }
}

START_TEST(even_paths_differ_less)
{
    random_source r = {7};
    int n_better = 0, n_worse = 0;
    for (int trial = 0; trial < TRIALS; ++trial) {
        uint32_t at[N];
        web is_short, is_even;
        surface_star(&one, SPLITS, .3, &r);
        surface_star(&two, SPLITS, .3, &r);
        draw_landmarks(at, &r);
        ck_assert_int_eq(lay(&is_short, at, false, HUGE_VAL), ICC_OK);
        ck_assert_int_eq(lay(&is_even, at, true, HUGE_VAL), ICC_OK);
        n_better += is_even.report.worst < .9 * is_short.report.worst;
        n_worse += is_short.report.worst < .9 * is_even.report.worst;
        ck_assert_int_eq(lay(&is_even, at, true, 1 + .5 * (is_even.report.worst - 1)),
                         ICC_ERR_RESOLUTION);
    }
    ck_assert_msg(n_better > 3 * n_worse, "%d better, %d worse", n_better, n_worse);
}
END_TEST

START_TEST(where_surfaces_are_equal_short_paths_are_even)
{
    random_source r = {11};
    for (int trial = 0; trial < TRIALS; ++trial) {
        uint32_t at[N];
        web is_short, is_even;
        surface_star(&one, SPLITS, .3, &r);
        two = one;
        draw_landmarks(at, &r);
        ck_assert_int_eq(lay(&is_short, at, false, HUGE_VAL), ICC_OK);
        ck_assert_int_eq(lay(&is_even, at, true, 1), ICC_OK);
        ck_assert(is_short.report.worst == 1 && is_even.report.worst == 1);
        ck_assert(memcmp(is_short.ends, is_even.ends, sizeof is_short.ends) == 0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("landmark paths");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, even_paths_differ_less);
    tcase_add_test(tests, where_surfaces_are_equal_short_paths_are_even);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
