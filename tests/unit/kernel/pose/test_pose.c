/* Poses: their derivatives, affine maps, and turns of handles. */
#include "../../../handle_fixtures.h"
#include "../../../suite.h"

#include <math.h>
#include <string.h>

static void pose(const icc_weights *weights, size_t n, const double *points,
                 const double *transforms, double *images, double *jacobians)
{
    icc_binding *binding;
    ck_assert_int_eq(
        icc_binding_create(&binding, weights, n, points, jacobians != NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_binding_pose(binding, transforms, images, jacobians, NULL), ICC_OK);
    icc_binding_free(binding);
}

/* (3.44) against central differences, with the default kernel and with the thesis' left whole. */
START_TEST(jacobians_are_derivatives)
{
    const size_t dim = _i % 2 ? 3 : 2, m = dim == 2 ? 5 : 8, n = 40;
    icc_sampling *sampling = dim == 2 ? sample_square(0.05) : sample_cube();
    const icc_weights_options options = {.size = sizeof options,
                                         .kernel = _i / 2 ? ICC_KERNEL_GAUSS : ICC_KERNEL_WENDLAND,
                                         .cutoff = 7,
                                         .sigma = dim == 2 ? 0 : 0.1};
    icc_weights *weights = make(sampling, m, dim == 2 ? HANDLES : CUBE, &options);
    double *points = random_places(dim, n), *moved = allocate(n * dim, sizeof *moved),
           transforms[96], worst = 0;
    double *images = allocate(n * dim, sizeof *images),
           *jacobians = allocate(n * dim * dim, sizeof *images);
    double *ahead = allocate(n * dim, sizeof *images), *behind = allocate(n * dim, sizeof *images);
    random_source r = {12};
    random_transforms(dim, m, transforms, &r);
    pose(weights, n, points, transforms, images, jacobians);
    const double h = 1e-6;
    for (size_t k = 0; k < dim; ++k) {
        for (size_t i = 0; i < n * dim; ++i)
            moved[i] = points[i] + (i % dim == k ? h : 0);
        pose(weights, n, moved, transforms, ahead, NULL);
        for (size_t i = 0; i < n * dim; ++i)
            moved[i] = points[i] - (i % dim == k ? h : 0);
        pose(weights, n, moved, transforms, behind, NULL);
        for (size_t i = 0; i < n * dim; ++i)
            worst = fmax(worst, fabs((ahead[i] - behind[i]) / (2 * h) - jacobians[dim * i + k]));
    }
    ck_assert_msg(worst <= 1e-7, "Jacobians deviate by %g", worst);
    free(points);
    free(moved);
    free(images);
    free(jacobians);
    free(ahead);
    free(behind);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

/* Nothing moved: every bit of the points comes back. All moved alike: that affine map. */
START_TEST(poses_are_affine_when_all_handles_agree)
{
    const size_t dim = _i ? 3 : 2, m = dim == 2 ? 4 : 8, size = dim * (dim + 1), n = 300;
    icc_sampling *sampling = dim == 2 ? sample_square(0.1) : sample_cube();
    icc_weights *weights = make(sampling, m, dim == 2 ? SQUARE : CUBE, NULL);
    double *points = random_places(dim, n), *images = allocate(n * dim, sizeof *images);
    double *jacobians = allocate(n * dim * dim, sizeof *jacobians), transforms[96];
    random_source r = {3};
    ck_assert_int_eq(icc_pose_reset((int32_t)dim, m, transforms), ICC_OK);
    pose(weights, n, points, transforms, images, jacobians);
    ck_assert_mem_eq(points, images, n * dim * sizeof *points);
    random_transforms(dim, 1, transforms, &r);
    for (size_t j = 1; j < m; ++j)
        memcpy(transforms + size * j, transforms, size * sizeof *transforms);
    pose(weights, n, points, transforms, images, jacobians);
    for (size_t i = 0; i < n * dim; ++i) {
        const double *row = transforms + (dim + 1) * (i % dim), *x = points + i - i % dim;
        double image = row[dim];
        for (size_t k = 0; k < dim; ++k) {
            image += row[k] * x[k];
            ck_assert_double_eq_tol(jacobians[dim * i + k], row[k], 1e-10);
        }
        ck_assert_double_eq_tol(images[i], image, 1e-12);
    }
    free(points);
    free(images);
    free(jacobians);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

/* A turn keeps its handle where it is and lengths what they are, goes counter-clockwise, and adds
 * up. */
START_TEST(handles_turn_about_themselves)
{
    const double angle = 0.7, offset[3] = {2, -1, 0.5}, at[3] = {0.3, 0.8, -0.4},
                 axis[3] = {1, 2, -2};
    double flat[6], space[12], twice[12];
    ck_assert_int_eq(icc_pose_reset(2, 1, flat), ICC_OK);
    ck_assert_int_eq(icc_pose_move(2, flat, offset), ICC_OK);
    ck_assert_int_eq(icc_pose_turn(2, flat, at, NULL, angle), ICC_OK);
    const double tip[2] = {at[0] + 1, at[1]};
    for (int k = 0; k < 2; ++k) {
        const double *row = flat + 3 * k;
        ck_assert_double_eq_tol(row[0] * at[0] + row[1] * at[1] + row[2], at[k] + offset[k], 1e-15);
        ck_assert_double_eq_tol(row[0] * tip[0] + row[1] * tip[1] + row[2],
                                at[k] + offset[k] + (k == 0 ? cos(angle) : sin(angle)), 1e-14);
    }
    ck_assert_int_eq(icc_pose_reset(3, 1, space), ICC_OK);
    ck_assert_int_eq(icc_pose_move(3, space, offset), ICC_OK);
    memcpy(twice, space, sizeof space);
    ck_assert_int_eq(icc_pose_turn(3, space, at, axis, angle), ICC_OK);
    ck_assert_int_eq(icc_pose_turn(3, twice, at, axis, angle / 2), ICC_OK);
    ck_assert_int_eq(icc_pose_turn(3, twice, at, axis, angle / 2), ICC_OK);
    for (int i = 0; i < 3; ++i) {
        double along = 0, fixed = space[4 * i + 3];
        for (int k = 0; k < 3; ++k) {
            along += space[4 * i + k] * axis[k];
            fixed += space[4 * i + k] * at[k];
        }
        ck_assert_double_eq_tol(along, axis[i], 1e-14);
        ck_assert_double_eq_tol(fixed, at[i] + offset[i], 1e-14);
        for (int k = 0; k < 4; ++k)
            ck_assert_double_eq_tol(space[4 * i + k], twice[4 * i + k], 1e-14);
    }
    double up[12];
    ck_assert_int_eq(icc_pose_reset(3, 1, up), ICC_OK);
    ck_assert_int_eq(icc_pose_turn(3, up, at, (double[3]){0, 0, 5}, angle), ICC_OK);
    ck_assert_double_eq_tol(up[0], cos(angle), 1e-15);
    ck_assert_double_eq_tol(up[4], sin(angle), 1e-15);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("pose");
    TCase *tests = tcase_create("pose");
    tcase_add_loop_test(tests, jacobians_are_derivatives, 0, 4);
    tcase_add_loop_test(tests, poses_are_affine_when_all_handles_agree, 0, 2);
    tcase_add_test(tests, handles_turn_about_themselves);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
