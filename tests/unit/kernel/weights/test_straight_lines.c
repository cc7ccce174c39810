/* Lines that stay straight, share ends, or stay parallel. */
#include "../../../handle_fixtures.h"
#include "../../../suite.h"

#include <math.h>

/* The greatest deviation from linear of the weights between two places. */
static double crookedness(const icc_weights *weights, const double *from, const double *to,
                          size_t n)
{
    const size_t m = info_of(weights).n_handles;
    double *points = allocate(2 * (n + 1), sizeof *points),
           *values = allocate(m * (n + 1), sizeof *values);
    double worst = 0;
    for (size_t i = 0; i <= 2 * n + 1; ++i)
        points[i] = from[i % 2] + (double)(i / 2) / (double)n * (to[i % 2] - from[i % 2]);
    ck_assert_int_eq(icc_weights_evaluate(weights, n + 1, points, values, NULL, NULL, NULL, NULL),
                     ICC_OK);
    for (size_t i = 0; i < m * (n + 1); ++i) {
        const double share = (double)(i / m) / (double)n;
        const double line = (1 - share) * values[i % m] + share * values[m * n + i % m];
        worst = fmax(worst, fabs(values[i] - line));
    }
    free(points);
    free(values);
    return worst;
}

/* A line of 21 nodes is straight at them, and between them bends ten times less than without (on
 * the thesis' star, which is in the benchmark, by less than 1e-3). */
START_TEST(lines_stay_straight)
{
    icc_sampling *sampling = sample_square(0.02);
    const icc_line line = {.from = {0.3, 0.25}, .to = {0.62, 0.49}}; /* 20 spacings long */
    const icc_weights_options with = {.size = sizeof with, .n_lines = 1, .lines = &line};
    icc_weights *plain = make(sampling, 5, HANDLES, NULL),
                *kernel = make(sampling, 5, HANDLES, &with);
    ck_assert_double_le(crookedness(kernel, line.from, line.to, 20), 1e-13);
    ck_assert_double_le(crookedness(kernel, line.from, line.to, 777), 1.5e-3);
    ck_assert_double_gt(crookedness(plain, line.from, line.to, 777), 1.5e-2);
    ck_assert_double_le(report_of(kernel).reproduction, 1e-11);
    icc_weights_free(plain);
    icc_weights_free(kernel);
    icc_sampling_free(sampling);
}
END_TEST

/* Lines may begin at handles and go on from each other. */
START_TEST(lines_share_ends)
{
    icc_sampling *sampling = sample_square(0.04);
    const icc_line lines[3] = {{.from = {0.3, 0.6}, .to = {0.7, 0.8}},
                               {.from = {0.7, 0.8}, .to = {0.8, 0.3}},
                               {.from = {0, 0}, .to = {1, 0}}};
    const icc_weights_options options = {.size = sizeof options, .n_lines = 3, .lines = lines};
    icc_weights *weights = make(sampling, 5, HANDLES, &options),
                *plain = make(sampling, 5, HANDLES, NULL);
    double *points = nodes_of(weights), least = HUGE_VAL;
    const size_t n = info_of(weights).n_nodes;
    for (size_t i = 0; i < n; ++i)
        for (size_t j = 0; j < i; ++j)
            least = fmin(
                least, hypot(points[2 * i] - points[2 * j], points[2 * i + 1] - points[2 * j + 1]));
    ck_assert_double_gt(least, 0.4 * 0.04);
    for (int k = 0; k < 3; ++k)
        ck_assert_double_le(crookedness(weights, lines[k].from, lines[k].to, 600), 0.1);
    ck_assert_double_gt(crookedness(plain, lines[0].from, lines[0].to, 600), 0.3);
    /* Both ends of the last one are handles: the pieces of a unit length are 25. */
    ck_assert_double_le(crookedness(weights, lines[2].from, lines[2].to, 25), 1e-13);
    free(points);
    icc_weights_free(plain);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

/* Parallel lines have the same change of weights per length, in either direction, and moved handles
 * keep them parallel. */
START_TEST(parallel_lines_stay_parallel)
{
    icc_sampling *sampling = sample_square(0.04);
    const icc_line lines[2] = {{.from = {0.2, 0.25}, .to = {0.6, 0.35}},
                               {.from = {0.75, 0.8}, .to = {0.15, 0.65}, .parallel = 1}};
    const icc_weights_options options = {.size = sizeof options, .n_lines = 2, .lines = lines};
    icc_weights *weights = make(sampling, 5, HANDLES, &options);
    const double ends[8] = {0.2, 0.25, 0.6, 0.35, 0.75, 0.8, 0.15, 0.65};
    icc_binding *binding;
    double transforms[30], images[8];
    random_source r = {6};
    ck_assert_int_eq(icc_binding_create(&binding, weights, 4, ends, 0, NULL, NULL), ICC_OK);
    for (int k = 0; k < 50; ++k) {
        ck_assert_int_eq(icc_pose_reset(2, 5, transforms), ICC_OK);
        for (int j = 0; j < 5; ++j) {
            const double offset[2] = {random_between(&r, -1, 1), random_between(&r, -1, 1)};
            ck_assert_int_eq(icc_pose_move(2, transforms + 6 * j, offset), ICC_OK);
        }
        ck_assert_int_eq(icc_binding_pose(binding, transforms, images, NULL, NULL), ICC_OK);
        const double u[2] = {images[2] - images[0], images[3] - images[1]};
        const double v[2] = {images[6] - images[4], images[7] - images[5]};
        ck_assert_double_le(fabs(u[0] * v[1] - u[1] * v[0]), 1e-14);
        ck_assert_double_eq_tol(hypot(v[0], v[1]), 1.5 * hypot(u[0], u[1]), 1e-13);
    }
    icc_binding_free(binding);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("straight_lines");
    TCase *tests = tcase_create("straight_lines");
    tcase_add_test(tests, lines_stay_straight);
    tcase_add_test(tests, lines_share_ends);
    tcase_add_test(tests, parallel_lines_stay_parallel);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
