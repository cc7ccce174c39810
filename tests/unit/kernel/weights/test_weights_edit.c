/* Weights made from others: painted, repainted, by another method, stiffened. */
#include "../../../handle_fixtures.h"
#include "../../../suite.h"

#include <math.h>
#include <string.h>

/* Dual functions are 1 and 0 at the nodes, and add up to 1 and to the weights. */
START_TEST(weights_are_sums_of_dual_functions)
{
    enum { N = 40 };
    icc_sampling *sampling = sample_square(0.2);
    icc_weights *weights = make(sampling, 5, HANDLES, NULL);
    icc_sampling_free(sampling);
    const size_t n = info_of(weights).n_nodes;
    double *nodes = nodes_of(weights), *at_nodes = weights_of(weights);
    double *values = malloc(n * sizeof *values), points[2 * N], direct[5 * N], one[N];
    double sums[6 * N] = {0};
    ck_assert_ptr_nonnull(values);
    for (size_t i = 0; i < N; ++i) {
        points[2 * i] = fmod(0.5 + 0.7548776662466927 * (double)i, 1);
        points[2 * i + 1] = fmod(0.5 + 0.5698402909980532 * (double)i, 1);
    }
    for (size_t k = 0; k < n; ++k) {
        ck_assert_int_eq(icc_weights_get_dual(weights, k, n, nodes, values, NULL, NULL), ICC_OK);
        for (size_t i = 0; i < n; ++i)
            ck_assert_double_eq_tol(values[i], i == k, 1e-10);
        ck_assert_int_eq(icc_weights_get_dual(weights, k, N, points, one, NULL, NULL), ICC_OK);
        for (size_t i = 0; i < N; ++i) {
            for (size_t j = 0; j < 5; ++j)
                sums[6 * i + j] += one[i] * at_nodes[5 * k + j];
            sums[6 * i + 5] += one[i];
        }
    }
    ck_assert_int_eq(icc_weights_evaluate(weights, N, points, direct, NULL, NULL, NULL, NULL),
                     ICC_OK);
    for (size_t i = 0; i < N; ++i) {
        for (size_t j = 0; j < 5; ++j)
            ck_assert_double_eq_tol(sums[6 * i + j], direct[5 * i + j], 1e-10);
        ck_assert_double_eq_tol(sums[6 * i + 5], 1, 1e-10);
    }
    free(nodes);
    free(at_nodes);
    free(values);
    icc_weights_free(weights);
}
END_TEST

static icc_weights *paint(const icc_weights *weights, size_t handle, double x, double y,
                          double radius, double amount)
{
    icc_weights *painted;
    const double centre[2] = {x, y};
    ck_assert_int_eq(
        icc_weights_paint(&painted, weights, handle, centre, radius, amount, NULL, NULL), ICC_OK);
    return painted;
}

START_TEST(paint_changes_what_is_under_the_brush)
{
    icc_sampling *sampling = sample_square(0.05);
    icc_weights *weights = make(sampling, 5, HANDLES, NULL);
    icc_sampling_free(sampling);
    icc_weights *painted = paint(weights, 2, 0.5, 0.4, 0.2, 0.3),
                *same = paint(weights, 2, 0.5, 0.4, 0.2, 0);
    double *before = weights_of(weights), *after = weights_of(painted), *still = weights_of(same);
    double *points = nodes_of(weights), gain = 0;
    for (size_t i = 0; i < info_of(weights).n_nodes; ++i) {
        const double d = hypot(points[2 * i] - 0.5, points[2 * i + 1] - 0.4);
        if (d >= 0.2)
            ck_assert_mem_eq(before + 5 * i, after + 5 * i, 5 * sizeof *before);
        if (d < 0.05)
            gain = fmax(gain, after[5 * i + 2] - before[5 * i + 2]);
        for (size_t j = 0; j < 5; ++j)
            ck_assert_double_eq_tol(before[5 * i + j], still[5 * i + j], 1e-12);
    }
    ck_assert_double_gt(gain, 0.05);
    ck_assert_double_le(report_of(painted).reproduction, 1e-11);
    ck_assert_double_le(report_of(painted).lagrange, 1e-11);
    free(before);
    free(after);
    free(still);
    free(points);
    icc_weights_free(weights);
    icc_weights_free(painted);
    icc_weights_free(same);
}
END_TEST

/* Wishes at some nodes: all at once is the same as one after the other; those of others are
 * refused. */
START_TEST(repainting_takes_wishes)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_weights *weights = make(sampling, 5, HANDLES, NULL), *both, *one, *two;
    const uint32_t nodes[3] = {20, 2, 33}, twice[2] = {20, 20}, none = 1u << 30;
    const double wishes[15] = {1, 0, 0, 0, 0, 7, 7, 7, 7, 7, 0, 0, 1, 0, 0};
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_weights_repaint(&both, weights, 3, nodes, wishes, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_weights_repaint(&one, weights, 1, nodes, wishes, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_weights_repaint(&two, one, 2, nodes + 1, wishes + 5, NULL, NULL), ICC_OK);
    double *a = weights_of(both), *b = weights_of(two), *old = weights_of(weights), at[10], at2[10];
    const size_t n = info_of(weights).n_nodes;
    ck_assert_mem_eq(a, b, 5 * n * sizeof *a);
    for (size_t i = 0; i < 5 * n; ++i)
        ck_assert(a[i] == old[i] || i / 5 == 20 || i / 5 == 33);
    ck_assert_int_ne(memcmp(a + 100, old + 100, 5 * sizeof *a), 0);
    const double points[4] = {0.35, 0.4, 0.8, 0.7};
    ck_assert_int_eq(icc_weights_evaluate(both, 2, points, at, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_weights_evaluate(two, 2, points, at2, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_mem_eq(at, at2, sizeof at);
    icc_weights_free(two);
    ck_assert_int_eq(icc_weights_repaint(&two, weights, 2, twice, wishes, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(err.message, "twice"));
    ck_assert_int_eq(icc_weights_repaint(&two, weights, 1, &none, wishes, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(two);
    free(a);
    free(b);
    free(old);
    icc_weights_free(weights);
    icc_weights_free(both);
    icc_weights_free(one);
    icc_sampling_free(sampling);
}
END_TEST

/* Another method starts from the initial weights: paint is gone, and the kernel is the one made
 * with that method. */
START_TEST(another_method_starts_afresh)
{
    icc_sampling *sampling = sample_square(0.06);
    const icc_line line = {.from = {0.3, 0.2}, .to = {0.8, 0.5}};
    icc_weights_options options = {
        .size = sizeof options, .n_lines = 1, .lines = &line, .n_edges = 4, .edges = RING};
    icc_weights *weights = make(sampling, 5, HANDLES, &options);
    icc_weights *painted = paint(weights, 1, 0.4, 0.4, 0.3, 1);
    double *points = random_places(2, 300), *a = allocate(1500, sizeof *a),
           *b = allocate(1500, sizeof *b);
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        icc_weights *switched, *direct;
        options.method = method;
        direct = make(sampling, 5, HANDLES, &options);
        ck_assert_int_eq(icc_weights_with_method(&switched, painted, method, NULL, NULL), ICC_OK);
        ck_assert_int_eq(info_of(switched).method, method);
        ck_assert_int_eq(icc_weights_evaluate(direct, 300, points, a, NULL, NULL, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_weights_evaluate(switched, 300, points, b, NULL, NULL, NULL, NULL),
                         ICC_OK);
        ck_assert_mem_eq(a, b, 1500 * sizeof *a);
        icc_weights_free(switched);
        icc_weights_free(direct);
    }
    free(points);
    free(a);
    free(b);
    icc_weights_free(weights);
    icc_weights_free(painted);
    icc_sampling_free(sampling);
}
END_TEST

static double gradient_energy(const icc_weights *weights, size_t n, const uint32_t *nodes)
{
    const size_t m = info_of(weights).n_handles;
    double *points = nodes_of(weights), *values = allocate(m, sizeof *values), sum = 0;
    double *gradients = allocate(2 * m, sizeof *gradients);
    for (size_t k = 0; k < n; ++k) {
        ck_assert_int_eq(icc_weights_evaluate(weights, 1, points + 2 * nodes[k], values, gradients,
                                              NULL, NULL, NULL),
                         ICC_OK);
        for (size_t j = 0; j < 2 * m; ++j)
            sum += 0.5 * gradients[j] * gradients[j];
    }
    free(points);
    free(values);
    free(gradients);
    return sum;
}

/* A stiffer part: less energy, as promised, and everything else that weights do still holds. */
START_TEST(stiff_parts_vary_less)
{
    icc_sampling *sampling = sample_square(0.05);
    const icc_weights_options options = {.size = sizeof options, .n_edges = 4, .edges = RING};
    icc_weights *weights = make(sampling, 5, HANDLES, &options), *stiff;
    double *points = nodes_of(weights), energy[2];
    const size_t n = info_of(weights).n_nodes;
    uint32_t *part = allocate(n, sizeof *part);
    size_t n_part = 0;
    for (uint32_t i = 0; i < n; ++i)
        if (hypot(points[2 * i] - 0.25, points[2 * i + 1] - 0.5) < 0.2)
            part[n_part++] = i;
    ck_assert_int_eq(icc_weights_stiffen(&stiff, weights, n_part, part, NULL, energy, NULL, NULL),
                     ICC_OK);
    ck_assert_double_lt(energy[1], 0.9 * energy[0]);
    ck_assert_double_eq_tol(gradient_energy(stiff, n_part, part) /
                                gradient_energy(weights, n_part, part),
                            energy[1] / energy[0], 1e-6);
    const icc_weights_report report = report_of(stiff);
    ck_assert_double_le(report.unity, 1e-11);
    ck_assert_double_le(report.reproduction, 1e-11);
    ck_assert_double_le(report.lagrange, 1e-11);
    free(points);
    free(part);
    icc_weights_free(weights);
    icc_weights_free(stiff);
    icc_sampling_free(sampling);
}
END_TEST

/* Three handles leave no choice, and weights that have been stiffened hardly any: both are answers,
 * and the second has no more energy. */
START_TEST(stiff_parts_without_freedom_stay)
{
    icc_sampling *sampling = sample_square(0.05);
    uint32_t part[40];
    for (uint32_t i = 0; i < 40; ++i)
        part[i] = 100 + i;
    for (size_t n_handles = 3; n_handles <= 5; n_handles += 2) {
        icc_weights *weights = make(sampling, n_handles, HANDLES, NULL), *stiff, *again;
        double first[2], second[2];
        ck_assert_int_eq(icc_weights_stiffen(&stiff, weights, 40, part, NULL, first, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_weights_stiffen(&again, stiff, 40, part, NULL, second, NULL, NULL),
                         ICC_OK);
        ck_assert_double_le(second[1], first[1] * (1 + 1e-9));
        if (n_handles == 3) {
            double *before = weights_of(weights), *after = weights_of(again);
            for (size_t k = 0; k < 3 * info_of(weights).n_nodes; ++k)
                ck_assert_double_eq_tol(after[k], before[k], 1e-12);
            free(before);
            free(after);
        }
        icc_weights_free(weights);
        icc_weights_free(stiff);
        icc_weights_free(again);
    }
    icc_sampling_free(sampling);
}
END_TEST

START_TEST(a_part_without_nodes_changes_nothing)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_weights *weights = make(sampling, 5, HANDLES, NULL), *stiff;
    double energy[2] = {1, 1}, *before = weights_of(weights);
    ck_assert_int_eq(icc_weights_stiffen(&stiff, weights, 0, NULL, NULL, energy, NULL, NULL),
                     ICC_OK);
    double *after = weights_of(stiff);
    ck_assert_double_eq(energy[0], 0);
    ck_assert_double_eq(energy[1], 0);
    for (size_t k = 0; k < 5 * info_of(weights).n_nodes; ++k)
        ck_assert_double_eq_tol(after[k], before[k], 1e-12);
    free(before);
    free(after);
    icc_weights_free(stiff);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("weights_edit");
    TCase *tests = tcase_create("weights_edit");
    tcase_add_test(tests, weights_are_sums_of_dual_functions);
    tcase_add_test(tests, paint_changes_what_is_under_the_brush);
    tcase_add_test(tests, repainting_takes_wishes);
    tcase_add_test(tests, another_method_starts_afresh);
    tcase_add_test(tests, stiff_parts_vary_less);
    tcase_add_test(tests, stiff_parts_without_freedom_stay);
    tcase_add_test(tests, a_part_without_nodes_changes_nothing);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
