/* Targets that move: they are reached however far they are, and by points inside without crossing
 * one another's way. */
#include <check.h>
#include <stdlib.h>

#include "../dragging.h"
#include "../faulty.h"
#include "../hard_shapes.h"
#include "../suite.h"

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
    status = icc_map_retarget(&next, map, target, NULL, NULL, &err);
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

/* Steps are so large that meshes lock: maps are made anew, too. */
START_TEST(points_go_round_one_another)
{
    enum { FRAMES = 20, POINTS = 8 };
    static drag_word expected[DRAG_PATHS], found[DRAG_PATHS];
    const drag d = drag_create(POINTS, 0.35, 0.2, 0.03, (uint64_t)_i);
    icc_error err = {.size = sizeof err};
    icc_domain *source;
    icc_map *map = NULL;
    ck_assert_int_eq(drag_domain(&source, &d, 0, &err), ICC_OK);
    const icc_status status = icc_map_create(&map, source, source, NULL, NULL, &err);
    map = made(status, map, &err);
    drag_words(map, &d, 0, expected);
    double last = 0;
    for (int frame = 1; frame <= FRAMES; ++frame) {
        const double angle = 6.28318530717958647692 * frame / FRAMES;
        icc_map_info info = {.size = sizeof info};
        icc_domain *target;
        icc_map *next = NULL;
        ck_assert_int_eq(drag_domain(&target, &d, angle, &err), ICC_OK);
        const icc_status step = icc_map_retarget(&next, map, target, NULL, NULL, &err);
        next = made(step, next, &err);
        icc_map_free(map);
        icc_domain_free(target);
        map = next;
        ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
        ck_assert_int_eq(info.class_kept, 1);
        drag_move(&d, last, angle, DRAG_PATHS, expected);
        drag_words(map, &d, angle, found);
        for (int k = 0; k < DRAG_PATHS; ++k)
            ck_assert_msg(drag_same(&expected[k], &found[k]), "frame %d, path %d", frame, k);
        for (int k = 0; k < POINTS; ++k) {
            double p[2], place[2], image[2];
            drag_place(&d, k, 0, p);
            drag_place(&d, k, angle, place);
            ck_assert_int_eq(icc_map_apply(map, 1, p, image, NULL, NULL, NULL), ICC_OK);
            ck_assert_msg(hypot(image[0] - place[0], image[1] - place[1]) < 1e-15, "point %d", k);
        }
        last = angle;
    }
    icc_map_free(map);
    icc_domain_free(source);
}
END_TEST

/* Two points that would meet half way. */
START_TEST(points_that_meet_are_refused)
{
    static const double SQUARE[8] = {0, 0, 1, 0, 1, 1, 0, 1}, PLACES[4] = {.25, .5, .75, .5};
    icc_error err = {.size = sizeof err};
    icc_domain *domain[2];
    icc_map *map = NULL, *next = NULL;
    for (int k = 0; k < 2; ++k) {
        const icc_feature features[2] = {
            {sizeof *features, ICC_FEATURE_POINT, 1, PLACES + 2 * k, 0, 0, NULL},
            {sizeof *features, ICC_FEATURE_POINT, 1, PLACES + 2 * (1 - k), 0, 0, NULL}};
        ck_assert_int_eq(icc_domain_create_features(&domain[k], 4, SQUARE, 2, features, NULL, &err),
                         ICC_OK);
    }
    const icc_status status = icc_map_create(&map, domain[0], domain[0], NULL, NULL, &err);
    map = made(status, map, &err);
    ck_assert_int_eq(icc_map_retarget(&next, map, domain[1], NULL, NULL, &err),
                     ICC_ERR_CERTIFICATE);
    ck_assert_ptr_null(next);
    icc_map_free(map);
    icc_domain_free(domain[0]);
    icc_domain_free(domain[1]);
}
END_TEST

/* ---- failures ---- */

typedef struct job {
    drag d;
    icc_map *map;
    icc_domain *target;
} job;

static icc_status run_job(const icc_env *env, icc_error *err, void *argument)
{
    const job *j = argument;
    icc_map *next = NULL;
    const icc_status status = icc_map_retarget(&next, j->map, j->target, NULL, env, err);
    icc_map_free(next);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    icc_error err = {.size = sizeof err};
    job j = {.d = drag_create(3, 0.5, 0.2, 0.03, 2)};
    icc_domain *source;
    ck_assert_int_eq(drag_domain(&source, &j.d, 0, &err), ICC_OK);
    ck_assert_int_eq(drag_domain(&j.target, &j.d, 2, &err), ICC_OK);
    ck_assert_int_eq(icc_map_create(&j.map, source, source, NULL, NULL, &err), ICC_OK);
    faulty_sweep(run_job, &j);
    icc_map_free(j.map);
    icc_domain_free(source);
    icc_domain_free(j.target);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("drag");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, cages_go_far);
    tcase_add_loop_test(tests, points_go_round_one_another, 1, 3);
    tcase_add_test(tests, points_that_meet_are_refused);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
