/* Overlays in the place of inverted triangles: what stays, what is positive afterwards, and when
 * they are given up. */
#include "base/error.h"
#include "map/compatible/overlay_patches.h"

#include "../../../faulty.h"
#include "../../../plmaps.h"

enum { CELLS = 20 };

/* Without limits of work, and with as many corners as there may be. */
static icc_status overlay(iccp_plmap *map, size_t most, size_t *n_left, const iccp_env *env)
{
    iccp_work work = iccp_work_unlimited();
    return iccp_overlay_patches(map, most, &work, n_left, env);
}

static double distance(const double *a, const double *b)
{
    return hypot(a[0] - b[0], a[1] - b[1]);
}

static size_t boundary_of(const iccp_plmap *map)
{
    size_t n = 0;
    while (n < map->n_vertices && map->fixed[n] != ICCP_FREE)
        ++n;
    return n;
}

/* The inner vertex next to a place, which is given as shares of the box. */
static size_t vertex_at(const iccp_plmap *map, double right, double up)
{
    double low[2] = {HUGE_VAL, HUGE_VAL}, high[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < 2 * map->n_vertices; ++i) {
        low[i % 2] = fmin(low[i % 2], map->points[i]);
        high[i % 2] = fmax(high[i % 2], map->points[i]);
    }
    const double x = low[0] + right * (high[0] - low[0]), y = low[1] + up * (high[1] - low[1]);
    size_t best = boundary_of(map);
    for (size_t v = best; v < map->n_vertices; ++v)
        if (hypot(map->points[2 * v] - x, map->points[2 * v + 1] - y) <
            hypot(map->points[2 * best] - x, map->points[2 * best + 1] - y))
            best = v;
    return best;
}

/* Whether some vertex of a map has this point and this image. */
static bool has_vertex(const iccp_plmap *map, const double *point, const double *image)
{
    for (size_t v = 0; v < map->n_vertices; ++v)
        if (memcmp(map->points + 2 * v, point, 2 * sizeof *point) == 0 &&
            memcmp(map->images + 2 * v, image, 2 * sizeof *image) == 0)
            return true;
    return false;
}

static void check_boundary(const iccp_plmap *map, const iccp_plmap *before)
{
    const size_t n = boundary_of(before);
    ck_assert_uint_eq(boundary_of(map), n);
    ck_assert_mem_eq(map->points, before->points, 2 * n * sizeof *map->points);
    ck_assert_mem_eq(map->images, before->images, 2 * n * sizeof *map->images);
    ck_assert_mem_eq(map->fixed, before->fixed, n);
    ck_assert_mem_eq(map->facet, before->facet, n * sizeof *map->facet);
    ck_assert_mem_eq(map->along, before->along, n * sizeof *map->along);
}

/* One vertex lands in the triangles beside it, in two places far apart: vertices elsewhere keep
 * their points and images bit for bit. */
START_TEST(what_is_elsewhere_stays)
{
    const iccp_env env = default_env();
    const shape s = shape_square();
    iccp_plmap map = map_of(&s, CELLS, wave, 1), before;
    const size_t moved[2] = {vertex_at(&map, 0.25, 0.25), vertex_at(&map, 0.75, 0.75)};
    const double apart = distance(map.points + 2 * moved[0], map.points + 2 * moved[1]);
    size_t n_left, n_far = 0, n_lost = 0;
    for (int k = 0; k < 2; ++k)
        map.images[2 * moved[k]] += 0.2 * apart;
    ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
    ck_assert_uint_gt(iccp_plmap_count_inverted(&map), 0);
    ck_assert_int_eq(overlay(&map, boundary_of(&map) - 1, &n_left, &env), ICC_OK);
    ck_assert_uint_eq(n_left, 0);
    check_certified(&map);
    check_boundary(&map, &before);
    for (size_t v = 0; v < before.n_vertices; ++v) {
        const double *p = before.points + 2 * v;
        if (distance(p, before.points + 2 * moved[0]) < 0.6 * apart ||
            distance(p, before.points + 2 * moved[1]) < 0.6 * apart)
            continue;
        ++n_far;
        n_lost += !has_vertex(&map, p, before.images + 2 * v);
    }
    ck_assert_uint_gt(n_far, 50);
    ck_assert_uint_eq(n_lost, 0);
    iccp_plmap_free(&map);
    iccp_plmap_free(&before);
}
END_TEST

/* Disorder inside: either everything is positive, or all of it is still there. */
START_TEST(disorder_becomes_positive_or_is_given_up)
{
    const iccp_env env = default_env();
    size_t n_positive = 0;
    for (int k = 0; k < 3 * N_SHAPES; ++k) {
        const shape s = shape_number(k % N_SHAPES);
        random_source r = {(uint64_t)k};
        iccp_plmap map = map_of(&s, CELLS, identity, 1), before, again;
        size_t n_left, n_again;
        for (size_t v = boundary_of(&map); v < map.n_vertices; ++v)
            if (random_below(&r, 40) == 0)
                map.images[2 * v] += random_between(&r, -0.3, 0.3);
        ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
        ck_assert_int_eq(iccp_plmap_copy(&again, &map, &env.memory), ICC_OK);
        ck_assert_int_eq(overlay(&map, boundary_of(&map) - 1, &n_left, &env), ICC_OK);
        ck_assert_uint_eq(n_left, iccp_plmap_count_inverted(&map));
        n_positive += n_left == 0;
        check_mesh(&map);
        check_boundary(&map, &before);
        ck_assert_int_eq(overlay(&again, boundary_of(&again) - 1, &n_again, &env), ICC_OK);
        ck_assert(is_same(&map, &again) && n_left == n_again);
        iccp_plmap_free(&map);
        iccp_plmap_free(&before);
        iccp_plmap_free(&again);
    }
    ck_assert_uint_gt(n_positive, N_SHAPES);
}
END_TEST

/* A map that is one-to-one stays as it is, and so does one whose patches have too many corners. */
START_TEST(nothing_changes_without_need_or_without_room)
{
    const iccp_env env = default_env();
    const shape s = shape_star(5, 0.4, 0.1);
    iccp_plmap map = map_of(&s, CELLS, wave, 1), copy;
    for (int k = 0; k < 2; ++k) {
        size_t n_left;
        if (k == 1)
            map.images[2 * (map.n_vertices - 1)] += 1;
        const size_t n = iccp_plmap_count_inverted(&map);
        ck_assert_int_eq(iccp_plmap_copy(&copy, &map, &env.memory), ICC_OK);
        ck_assert_int_eq(overlay(&map, 2, &n_left, &env), ICC_OK);
        ck_assert_uint_eq(n_left, n);
        ck_assert((n > 0) == (k == 1));
        ck_assert(is_same(&map, &copy));
        iccp_plmap_free(&copy);
    }
    iccp_plmap_free(&map);
}
END_TEST

/* A boundary that runs clockwise after the map has no positive triangles. */
START_TEST(what_has_no_overlay_is_counted)
{
    const iccp_env env = default_env();
    const shape s = shape_square();
    iccp_plmap map = map_of(&s, 6, identity, 1);
    size_t n_left;
    for (size_t v = 0; v < map.n_vertices; ++v)
        map.images[2 * v] *= -1;
    ck_assert_int_eq(overlay(&map, map.n_vertices, &n_left, &env), ICC_OK);
    ck_assert_uint_eq(n_left, map.corners.n_triangles);
    iccp_plmap_free(&map);
}
END_TEST

static icc_status overlay_copy(const icc_env *env, icc_error *err, void *argument)
{
    iccp_env full;
    iccp_plmap map;
    size_t n_left;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    icc_status status = iccp_plmap_copy(&map, argument, &full.memory);
    if (status == ICC_OK)
        status = overlay(&map, boundary_of(&map) - 1, &n_left, &full);
    ck_assert(status != ICC_OK || n_left == 0);
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_maps_that_can_be_freed)
{
    const shape s = shape_square();
    iccp_plmap map = map_of(&s, 8, wave, 1);
    map.images[2 * vertex_at(&map, 0.5, 0.5)] += 0.3;
    ck_assert_uint_gt(iccp_plmap_count_inverted(&map), 0);
    faulty_sweep(overlay_copy, &map);
    iccp_plmap_free(&map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("overlay patches");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, what_is_elsewhere_stays);
    tcase_add_test(tests, disorder_becomes_positive_or_is_given_up);
    tcase_add_test(tests, nothing_changes_without_need_or_without_room);
    tcase_add_test(tests, what_has_no_overlay_is_counted);
    tcase_add_test(tests, failures_leave_maps_that_can_be_freed);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
