/* Weights of handles: sums, reproduction, edges, initial weights and units. */
#include "../../../handle_fixtures.h"
#include "../../../suite.h"

#include <math.h>
#include <string.h>

/* All kernels, starts and methods: sums, reproduction and Lagrange's property at nodes and between
 * them. */
START_TEST(weights_sum_to_one_and_reproduce)
{
    icc_sampling *sampling = sample_square(0.05);
    for (int32_t kernel = ICC_KERNEL_WENDLAND; kernel <= ICC_KERNEL_GAUSS; ++kernel)
        for (int32_t initial = ICC_INITIAL_HEAT; initial <= ICC_INITIAL_INVERSE; ++initial)
            for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
                const icc_weights_options options = {.size = sizeof options,
                                                     .kernel = kernel,
                                                     .initial = initial,
                                                     .method = method,
                                                     .n_edges = 4,
                                                     .edges = RING};
                icc_weights *k = make(sampling, 5, HANDLES, &options);
                const icc_weights_report report = report_of(k);
                ck_assert_double_le(report.unity, 1e-11);
                ck_assert_double_le(report.reproduction, 1e-11);
                ck_assert_double_le(report.reproduction_mean, report.reproduction);
                ck_assert_double_le(report.lagrange, 1e-11);
                ck_assert_uint_eq(report.n_infeasible, 0);
                const icc_weights_info info = info_of(k);
                ck_assert_int_eq(info.kernel, kernel);
                ck_assert_int_eq(info.initial, initial);
                ck_assert_int_eq(info.method, method);
                ck_assert_double_gt(info.definiteness, 0);
                double *weights = weights_of(k), *points = nodes_of(k);
                for (size_t i = 0; i < info.n_nodes; ++i) {
                    double sum = 0, x = 0, y = 0;
                    for (size_t j = 0; j < 5; ++j) {
                        const double w = weights[5 * i + j];
                        sum += w;
                        x += w * HANDLES[2 * j];
                        y += w * HANDLES[2 * j + 1];
                        if (method == ICC_WEIGHTS_QP)
                            ck_assert_double_ge(w, 0);
                        if (i < 5)
                            ck_assert(w == (i == j));
                    }
                    ck_assert_double_eq_tol(sum, 1, 1e-12);
                    ck_assert_double_eq_tol(x, points[2 * i], 1e-12);
                    ck_assert_double_eq_tol(y, points[2 * i + 1], 1e-12);
                }
                free(weights);
                free(points);
                icc_weights_free(k);
            }
    icc_sampling_free(sampling);
}
END_TEST

/* The thesis' way: without the affine function sums and reproduction are only near. */
START_TEST(without_the_affine_function_sums_are_only_near_one)
{
    icc_sampling *sampling = sample_square(0.05);
    const icc_weights_options options = {
        .size = sizeof options, .kernel = ICC_KERNEL_GAUSS, .affine_tail = -1};
    icc_weights *weights = make(sampling, 4, SQUARE, &options);
    const icc_weights_report report = report_of(weights);
    ck_assert_double_gt(report.unity, 1e-6);
    ck_assert_double_lt(report.unity, 0.3);
    ck_assert_double_le(report.lagrange, 1e-11);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

/* Held edges have exactly linear weights at the samples on them, and nearly so between. */
START_TEST(edges_are_linear)
{
    icc_sampling *sampling = sample_square(0.02);
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        const icc_weights_options options = {
            .size = sizeof options, .method = method, .n_edges = 4, .edges = RING};
        icc_weights *weights = make(sampling, 5, HANDLES, &options);
        ck_assert_int_eq(info_of(weights).initial, ICC_INITIAL_EDGES);
        double *values = weights_of(weights), *points = nodes_of(weights);
        size_t n_on_edge = 0;
        for (size_t i = 5; i < info_of(weights).n_nodes; ++i)
            if (points[2 * i + 1] <= 0) {
                ck_assert_double_eq_tol(values[5 * i], 1 - points[2 * i], 1e-15);
                ck_assert_double_eq_tol(values[5 * i + 1], points[2 * i], 1e-15);
                ck_assert(values[5 * i + 2] == 0 && values[5 * i + 3] == 0 &&
                          values[5 * i + 4] == 0);
                ++n_on_edge;
            }
        ck_assert_uint_gt(n_on_edge, 40);
        ck_assert_double_lt(report_of(weights).linearity, 0.03);
        free(values);
        free(points);
        icc_weights_free(weights);
    }
    icc_sampling_free(sampling);
}
END_TEST

START_TEST(a_cube_works_like_a_square)
{
    icc_sampling *sampling = sample_cube();
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        const icc_weights_options options = {.size = sizeof options, .method = method};
        icc_weights *weights = make(sampling, 8, CUBE, &options);
        const icc_weights_report report = report_of(weights);
        ck_assert_double_le(report.unity, 1e-11);
        ck_assert_double_le(report.reproduction, 1e-11);
        ck_assert_double_le(report.lagrange, 1e-11);
        ck_assert_double_gt(report.least_weight, -0.2);
        icc_weights_free(weights);
    }
    icc_sampling_free(sampling);
}
END_TEST

/* Initial weights of the caller's come back, at the samples that are nodes; handles have their
 * own. */
START_TEST(initial_weights_can_be_given)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_sampling_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_sampling_get_info(sampling, &info), ICC_OK);
    double *points = allocate(2 * info.n_samples, sizeof *points);
    double *given = allocate(4 * info.n_samples, sizeof *given);
    ck_assert_int_eq(icc_sampling_get_points(sampling, points), ICC_OK);
    for (size_t i = 0; i < 4 * info.n_samples; ++i)
        given[i] = cos((double)i);
    const icc_line line = {.from = {0.2, 0.3}, .to = {0.7, 0.4}};
    const icc_weights_options options = {.size = sizeof options,
                                         .initial = ICC_INITIAL_GIVEN,
                                         .initial_weights = given,
                                         .n_lines = 1,
                                         .lines = &line};
    icc_weights *weights = make(sampling, 4, SQUARE, &options);
    const size_t n = info_of(weights).n_nodes;
    double *initial = allocate(4 * n, sizeof *initial), *places = nodes_of(weights);
    ck_assert_int_eq(icc_weights_get_nodes(weights, NULL, initial, NULL, NULL), ICC_OK);
    size_t n_found = 0;
    for (size_t i = 0; i < n; ++i)
        for (size_t s = 0; i >= 4 && s < info.n_samples; ++s)
            if (memcmp(places + 2 * i, points + 2 * s, 2 * sizeof *points) == 0) {
                ck_assert_mem_eq(initial + 4 * i, given + 4 * s, 4 * sizeof *given);
                ++n_found;
            }
    ck_assert_uint_gt(n_found, n - 16);
    for (size_t j = 0; j < 16; ++j)
        ck_assert(initial[j] == (j % 5 == 0));
    ck_assert_double_le(report_of(weights).reproduction, 1e-11);
    given[4 * 17 + 2] = NAN;
    icc_weights *none = (icc_weights *)&none;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_weights_create(&none, sampling, 4, SQUARE, &options, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(none);
    ck_assert_int_eq(err.index, 17);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
    free(points);
    free(given);
    free(initial);
    free(places);
}
END_TEST

/* Weights do not depend on the unit of length: twice to the tenth times as large is the same, bit
 * for bit. */
START_TEST(weights_do_not_depend_on_the_unit)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_sampling_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_sampling_get_info(sampling, &info), ICC_OK);
    double *points = allocate(2 * info.n_samples, sizeof *points), handles[10], square[8];
    double *values[2], units[2] = {1, 1024};
    for (int u = 0; u < 2; ++u) {
        ck_assert_int_eq(icc_sampling_get_points(sampling, points), ICC_OK);
        for (size_t i = 0; i < 2 * info.n_samples; ++i)
            points[i] *= units[u];
        for (size_t i = 0; i < 10; ++i)
            handles[i] = HANDLES[i] * units[u];
        for (size_t i = 0; i < 8; ++i)
            square[i] = SQUARE[i] * units[u];
        icc_domain *domain;
        icc_shape *shape;
        icc_sampling *scaled;
        ck_assert_int_eq(icc_domain_create(&domain, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
        const icc_domain *regions[1] = {domain};
        ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 0, NULL, 0, NULL, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(
            icc_sampling_create_from_points(&scaled, shape, info.n_samples, points, NULL, NULL),
            ICC_OK);
        icc_weights *weights = make(scaled, 5, handles, NULL);
        values[u] = allocate(500 * 5, sizeof **values);
        double *places = random_places(2, 500);
        for (size_t i = 0; i < 1000; ++i)
            places[i] *= units[u];
        ck_assert_int_eq(
            icc_weights_evaluate(weights, 500, places, values[u], NULL, NULL, NULL, NULL), ICC_OK);
        icc_weights_free(weights);
        icc_sampling_free(scaled);
        icc_shape_free(shape);
        icc_domain_free(domain);
        free(places);
    }
    ck_assert_mem_eq(values[0], values[1], 2500 * sizeof **values);
    free(values[0]);
    free(values[1]);
    free(points);
    icc_sampling_free(sampling);
}
END_TEST

/* A single sample is enough beside the handles. */
START_TEST(one_sample_will_do)
{
    const double middle[2] = {0.5, 0.5};
    icc_domain *domain;
    icc_shape *shape;
    icc_sampling *sampling;
    ck_assert_int_eq(icc_domain_create(&domain, 2, 4, SQUARE, 0, NULL, NULL, NULL), ICC_OK);
    const icc_domain *regions[1] = {domain};
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 0, NULL, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, 1, middle, NULL, NULL),
                     ICC_OK);
    const icc_weights_options options = {.size = sizeof options, .sigma = 0.4};
    icc_weights *weights = make(sampling, 4, SQUARE, &options);
    ck_assert_double_le(report_of(weights).reproduction, 1e-13);
    ck_assert_double_le(report_of(weights).lagrange, 1e-13);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
    icc_shape_free(shape);
    icc_domain_free(domain);
}
END_TEST

/* Points that are not finite are named, and points far away have affine weights. */
START_TEST(any_point_may_be_asked)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_weights *weights = make(sampling, 4, SQUARE, NULL);
    const double points[8] = {0.5, 0.5, NAN, 0, 1e6, -1e6, 0.2, HUGE_VAL};
    double values[16], gradients[32];
    icc_status status[4];
    size_t n_failed;
    ck_assert_int_eq(
        icc_weights_evaluate(weights, 4, points, values, gradients, status, &n_failed, NULL),
        ICC_OK);
    ck_assert_uint_eq(n_failed, 2);
    for (int i = 0; i < 4; ++i) {
        ck_assert_int_eq(status[i], i % 2 == 0 ? ICC_OK : ICC_ERR_ARGUMENT);
        const double sum =
            values[4 * i] + values[4 * i + 1] + values[4 * i + 2] + values[4 * i + 3];
        ck_assert(i % 2 == 0 ? fabs(sum - 1) < 1e-6
                             : isnan(values[4 * i]) && isnan(gradients[8 * i + 7]));
    }
    ck_assert_int_eq(icc_weights_evaluate(weights, 0, NULL, NULL, NULL, NULL, NULL, NULL), ICC_OK);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("handle_weights");
    TCase *tests = tcase_create("handle_weights");
    tcase_add_test(tests, weights_sum_to_one_and_reproduce);
    tcase_add_test(tests, without_the_affine_function_sums_are_only_near_one);
    tcase_add_test(tests, edges_are_linear);
    tcase_add_test(tests, a_cube_works_like_a_square);
    tcase_add_test(tests, initial_weights_can_be_given);
    tcase_add_test(tests, weights_do_not_depend_on_the_unit);
    tcase_add_test(tests, one_sample_will_do);
    tcase_add_test(tests, any_point_may_be_asked);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
