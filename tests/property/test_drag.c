/* Targets that move: they are reached however far they are, and by points inside without crossing
 * one another's way. */
#include <check.h>
#include <stdlib.h>

#include "../dragging.h"
#include "../hard_shapes.h"

static icc_map *made(icc_status status, icc_map *map, const icc_error *err)
{
    ck_assert_msg(status == ICC_OK, "%s", err->message);
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert(info.certified == 1 && info.kind == ICC_MAP_MESH && isfinite(info.energy));
    return map;
}

/* From where it was to where another one is, in one call. */
static void jump(const shape *from, const shape *to)
{
    icc_error err = {.size = sizeof err};
    icc_domain *source, *target;
    icc_map *map = NULL, *next = NULL;
    ck_assert_int_eq(icc_domain_create(&source, 2, from->n, from->xy, 0, NULL, NULL, &err), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&target, 2, to->n, to->xy, 0, NULL, NULL, &err), ICC_OK);
    icc_status status = icc_map_create(&map, source, source, NULL, NULL, &err);
    map = made(status, map, &err);
    status = icc_map_retarget(&next, map, target, 0, NULL, &err);
    next = made(status, next, &err);
    ck_assert_ptr_null(icc_map_source_chart(next));
    icc_map_free(map);
    icc_map_free(next);
    icc_domain_free(source);
    icc_domain_free(target);
}

START_TEST(cages_go_far)
{
    const shape worm = shape_worm(12, 0.5, 0.6), star = shape_star(13, 0.4, 0.1);
    const shape turned = shape_star(13, 0.4, 3), far = shape_moved(&star, 2, 30, -20);
    const shape spiral = shape_spiral(12, 1.5);
    jump(&star, &turned);
    jump(&star, &far);
    jump(&star, &worm);
    jump(&worm, &star);
    jump(&worm, &spiral);
    jump(&spiral, &far);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("drag");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, cages_go_far);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
