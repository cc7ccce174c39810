/* What weights, bindings and poses refuse, and what they name as its cause. */
#include "../../../handle_fixtures.h"
#include "../../../suite.h"

#include <math.h>
#include <string.h>

static void refuse(const icc_sampling *sampling, size_t n, const double *handles,
                   const icc_weights_options *options, icc_status status, const char *text,
                   int64_t index)
{
    icc_weights *weights = (icc_weights *)&weights;
    icc_error err = {.size = sizeof err};
    const icc_status got = icc_weights_create(&weights, sampling, n, handles, options, NULL, &err);
    ck_assert_msg(got == status && err.status == status && err.index == index &&
                      strstr(err.message, text) != NULL,
                  "status %d, index %d, '%s' instead of %d, %d, '%s'", (int)got, (int)err.index,
                  err.message, (int)status, (int)index, text);
    ck_assert_ptr_null(weights);
}

START_TEST(impossible_handles_are_named)
{
    icc_sampling *sampling = sample_square(0.1);
    const double outside[8] = {0, 0, 1, 0, 1, 1, 0, 1.01}, twice[8] = {0, 0, 1, 0, 1, 1, 1, 0};
    const double collinear[8] = {0, 0, 1, 1, 0.5, 0.5, 0.25, 0.25},
                 wild[8] = {0, 0, 1, 0, 1, NAN, 0, 1};
    refuse(sampling, 4, outside, NULL, ICC_ERR_OUTSIDE, "outside", 3);
    refuse(sampling, 4, twice, NULL, ICC_ERR_ARGUMENT, "one place", 3);
    refuse(sampling, 4, collinear, NULL, ICC_ERR_ARGUMENT, "reproduce", -1);
    refuse(sampling, 2, SQUARE, NULL, ICC_ERR_ARGUMENT, "handles", -1);
    refuse(sampling, 4, wild, NULL, ICC_ERR_ARGUMENT, "handle 2 is not finite", 2);
    icc_sampling_free(sampling);
}
END_TEST

START_TEST(impossible_options_are_named)
{
    icc_sampling *sampling = sample_square(0.1);
    const uint32_t loop[4] = {0, 1, 2, 2}, far[2] = {0, 4};
    icc_weights_options bad[14];
    static const char *const TEXTS[14] = {
        "kernel",       "initial", "method",          "steps",        "affine_tail",
        "within_shape", "sigma",   "sigma",           "cutoff",       "edge 1 joins",
        "edge 0 joins", "no",      "initial_weights", "edges is NULL"};
    for (int k = 0; k < 14; ++k)
        bad[k] = (icc_weights_options){.size = sizeof *bad};
    bad[0].kernel = 3;
    bad[1].initial = 5;
    bad[2].method = -1;
    bad[3].steps = -1;
    bad[4].affine_tail = 2;
    bad[5].within_shape = -2;
    bad[6].sigma = NAN;
    bad[7].sigma = -1;
    bad[8].cutoff = HUGE_VAL;
    bad[9].n_edges = 2;
    bad[9].edges = loop;
    bad[10].n_edges = 1;
    bad[10].edges = far;
    bad[11].initial = ICC_INITIAL_EDGES;
    bad[12].initial = ICC_INITIAL_GIVEN;
    bad[13].n_edges = 1;
    for (int k = 0; k < 14; ++k)
        refuse(sampling, 4, SQUARE, &bad[k], ICC_ERR_ARGUMENT, TEXTS[k],
               k == 9    ? 1
               : k == 10 ? 0
                         : -1);
    icc_weights_options wide = {.size = sizeof wide, .kernel = ICC_KERNEL_GAUSS, .sigma = 0.2};
    refuse(sampling, 4, SQUARE, &wide, ICC_ERR_SOLVER, "sigma is too large", -1);
    wide.kernel = ICC_KERNEL_WENDLAND;
    icc_weights_free(make(sampling, 4, SQUARE, &wide));
    const icc_weights_options narrow = {.size = sizeof narrow, .sigma = 1e-9};
    refuse(sampling, 4, SQUARE, &narrow, ICC_ERR_ARGUMENT, "sigma is 1e-09", -1);
    icc_sampling_free(sampling);
}
END_TEST

START_TEST(impossible_lines_are_named)
{
    icc_sampling *sampling = sample_square(0.1);
    static const struct {
        icc_line lines[2];
        icc_status status;
        const char *text;
    } BAD[] = {
        {{{.from = {0.2, 0.2}, .to = {0.8, 0.2}}, {.from = {0.2, 0.4}, .to = {0.8, 1.2}}},
         ICC_ERR_OUTSIDE,
         "outside"},
        {{{.from = {0.2, 0.2}, .to = {0.8, 0.2}}, {.from = {0.2, 0.4}, .to = {0.21, 0.4}}},
         ICC_ERR_ARGUMENT,
         "shorter"},
        {{{.from = {0.2, 0.2}, .to = {0.8, 0.2}},
          {.from = {0.2, 0.4}, .to = {0.8, 0.5}, .parallel = 1}},
         ICC_ERR_ARGUMENT,
         "not parallel"},
        {{{.from = {0.2, 0.2}, .to = {0.8, 0.2}},
          {.from = {0.2, 0.4}, .to = {0.8, 0.4}, .parallel = 2}},
         ICC_ERR_ARGUMENT,
         "parallel is 2"},
        {{{.from = {0.2, 0.2}, .to = {0.8, 0.2}}, {.from = {0.4, 1}, .to = {0, 1}, .parallel = 1}},
         ICC_ERR_ARGUMENT,
         "cannot be made parallel"},
        {{{.from = {0.2, 0.2}, .to = {0.8, 0.2}}, {.from = {0.2, 0.4}, .to = {0.8, NAN}}},
         ICC_ERR_ARGUMENT,
         "not finite"},
    };
    for (size_t k = 0; k < sizeof BAD / sizeof *BAD; ++k) {
        const icc_weights_options options = {
            .size = sizeof options, .n_lines = 2, .lines = BAD[k].lines};
        refuse(sampling, 4, SQUARE, &options, BAD[k].status, BAD[k].text, 1);
    }
    icc_sampling_free(sampling);
}
END_TEST

START_TEST(impossible_calls_are_refused)
{
    icc_sampling *sampling = sample_square(0.1);
    icc_weights *weights = make(sampling, 4, SQUARE, NULL), *other = (icc_weights *)&other;
    const double centre[2] = {0.5, 0.5}, nowhere[2] = {0.5, NAN}, rigidity[1] = {-1},
                 wish[4] = {NAN};
    const uint32_t node = 9;
    double transforms[24], images[2], jacobians[4];
    ck_assert_int_eq(icc_weights_paint(&other, weights, 4, centre, 1, 1, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(other);
    ck_assert_int_eq(icc_weights_paint(&other, weights, 0, centre, 0, 1, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_paint(&other, weights, 0, nowhere, 1, 1, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_paint(&other, weights, 0, centre, 1, NAN, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_paint(&other, weights, 0, NULL, 1, 1, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_paint(NULL, weights, 0, centre, 1, 1, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_repaint(&other, weights, 1, &node, wish, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(
        icc_weights_get_dual(weights, info_of(weights).n_nodes, 1, centre, images, NULL, NULL),
        ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_get_dual(weights, 0, 1, nowhere, images, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_with_method(&other, weights, 5, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_weights_stiffen(&other, weights, 1, &node, rigidity, NULL, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    icc_binding *binding = (icc_binding *)&binding;
    ck_assert_int_eq(icc_binding_create(&binding, weights, 1, nowhere, 0, NULL, NULL),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(binding);
    ck_assert_int_eq(icc_binding_create(&binding, weights, 1, centre, 0, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_pose_reset(2, 4, transforms), ICC_OK);
    ck_assert_int_eq(icc_binding_pose(binding, transforms, images, jacobians, NULL),
                     ICC_ERR_UNSUPPORTED);
    transforms[7] = HUGE_VAL;
    ck_assert_int_eq(icc_binding_pose(binding, transforms, images, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_pose_reset(4, 4, transforms), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_pose_move(2, transforms, nowhere), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_pose_turn(3, transforms, (double[3]){0}, (double[3]){0}, 1),
                     ICC_ERR_ARGUMENT);
    icc_binding_free(binding);
    icc_weights_free(weights);
    icc_weights_free(NULL);
    icc_binding_free(NULL);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("weights_refusals");
    TCase *tests = tcase_create("weights_refusals");
    tcase_add_test(tests, impossible_handles_are_named);
    tcase_add_test(tests, impossible_options_are_named);
    tcase_add_test(tests, impossible_lines_are_named);
    tcase_add_test(tests, impossible_calls_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
