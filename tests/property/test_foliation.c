/* What holds for foliation coordinates of every shape. */
#define METHOD ICC_METHOD_FOLIATION
#include "../suite.h"
#include "certified.h"

START_TEST(hard_shapes_have_coordinates)
{
    const shape s = shape_hard(_i), reversed = shape_reversed(&s);
    check_chart(&s, 50, 100, 1e-12, shape_hard_slack(_i));
    check_chart(&reversed, 12, 100, 1e-12, shape_hard_slack(_i));
}
END_TEST

/* The caller's maximum is taken: the nearest mesh vertex. Outside there is none. */
START_TEST(the_caller_may_choose_the_maximum)
{
    random_source r = {8};
    for (int k = 0; k < 4 * N_SHAPES; ++k) {
        const shape plain = shape_number(k / 4), reversed = shape_reversed(&plain);
        const shape *outline = k % 2 ? &reversed : &plain;
        icc_chart_options options = method_options(25);
        subject s = subject_of(outline, &options);
        double own[2];
        pick_inside(&s, &r, own);
        subject_clear(&s);
        options.maximum = own;
        s = subject_of(outline, &options);
        /* Inner vertices keep 0.6 steps from the boundary, and from each other one. */
        ck_assert_double_le(distance_of(own, s.info.maximum), 2 * s.info.spacing);
        for (int i = 0; i < 100; ++i) {
            double p[2];
            pick_inside(&s, &r, p);
            check_round_trip(&s, p, 1e-11);
            if (i % 10 == 0)
                check_curve(&s, p, 1e-9);
        }
        const double outside[2] = {s.shape.upper[0] + 1, 0};
        icc_chart *none = (icc_chart *)&none;
        icc_error err = {.size = sizeof err};
        options.maximum = outside;
        ck_assert_int_eq(icc_chart_create(&none, s.domain, &options, NULL, &err), ICC_ERR_OUTSIDE);
        ck_assert(none == NULL && err.side == 0 && err.status == ICC_ERR_OUTSIDE);
        subject_clear(&s);
    }
}
END_TEST

/* Alone, the two domains of a map would end in different lobes. */
START_TEST(maxima_are_paired)
{
    const shape a = shape_dumbbell(0.3), b = shape_moved(&a, -1, 0, 0);
    icc_domain *source = domain_of_shape(&a), *target = domain_of_shape(&b);
    icc_map *map = map_of(source, target, 30);
    icc_chart_info info[2] = {{.size = sizeof *info}, {.size = sizeof *info}};
    (void)icc_chart_get_info(icc_map_source_chart(map), &info[0]);
    (void)icc_chart_get_info(icc_map_target_chart(map), &info[1]);
    for (int k = 0; k < 2; ++k)
        ck_assert_double_le(fabs(info[0].maximum[k] + info[1].maximum[k]), 2 * info[0].spacing);
    double image[2];
    apply(map, false, info[0].maximum, image);
    ck_assert_mem_eq(image, info[1].maximum, sizeof image);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("foliation");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    add_certified_tests(tests);
    tcase_add_loop_test(tests, hard_shapes_have_coordinates, 0, N_HARD_SHAPES);
    tcase_add_test(tests, the_caller_may_choose_the_maximum);
    tcase_add_test(tests, maxima_are_paired);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
