/* What holds for maps of random domains with features, there and back. */
#include "../flat_mesh.h"
#include "math/predicates.h"

#include "../feature_mixes.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <stdlib.h>

enum { N_MIXES = 20, N_IMPROVED = 3, MANY = 30000 };

static icc_map *map_of(const feature_mix *m, bool is_swapped, int32_t iterations,
                       const icc_env *env)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_error err = {.size = sizeof err};
    icc_map *map;
    if (icc_map_create(&map, m->domain[is_swapped], m->domain[!is_swapped], &options, env, &err) !=
        ICC_OK)
        ck_abort_msg("no map: %s", err.message);
    return map;
}

/* Triangles of domains near zero are not rounded on their way to the caller. */
static void check_triangles(const icc_map *map, const icc_map_info *info)
{
    double *points = malloc(2 * info->n_vertices * sizeof *points);
    double *images = malloc(2 * info->n_vertices * sizeof *images);
    uint32_t *corners = malloc(3 * info->n_simplices * sizeof *corners);
    ck_assert(points != NULL && images != NULL && corners != NULL);
    ck_assert_int_eq(flat_get_mesh(map, points, images, corners), ICC_OK);
    for (size_t t = 0; t < info->n_simplices; ++t) {
        const size_t a = 2 * (size_t)corners[3 * t], b = 2 * (size_t)corners[3 * t + 1],
                     c = 2 * (size_t)corners[3 * t + 2];
        ck_assert(iccp_orient2d(points + a, points + b, points + c) > 0 &&
                  iccp_orient2d(images + a, images + b, images + c) > 0);
    }
    free(points);
    free(images);
    free(corners);
}

static void check_mix(uint64_t seed, int32_t iterations)
{
    feature_mix m;
    mix_create(&m, seed);
    for (int swapped = 0; swapped < 2; ++swapped) {
        icc_map_info info = {.size = sizeof info};
        icc_map *map = map_of(&m, swapped, iterations, NULL);
        (void)icc_map_get_info(map, &info);
        ck_assert_msg(info.certified == 1, "seed %d", (int)seed);
        ck_assert_msg(info.class_kept == (m.n_features > 0), "seed %d", (int)seed);
        ck_assert_msg(info.energy >= 4 - 1e-9 && info.energy < HUGE_VAL, "seed %d", (int)seed);
        ck_assert_uint_eq(mix_count_off(&m, map, swapped), 0);
        ck_assert_uint_eq(mix_count_lost(&m, map, seed), 0);
        if (m.offset <= 0)
            check_triangles(map, &info);
        icc_map_free(map);
    }
    mix_free(&m);
}

/* By the start alone. */
START_TEST(starts)
{
    for (uint64_t seed = 0; seed < (uint64_t)share_of(N_MIXES); ++seed)
        check_mix(seed, -1);
}
END_TEST

/* The first two are seeds whose points and images, moving in turn, once made triangles too flat for
 * doubles. */
START_TEST(improved)
{
    static const uint64_t seeds[N_IMPROVED] = {42, 43, 11};
    for (int k = 0; k < share_of(N_IMPROVED); ++k)
        check_mix(seeds[k], 0);
}
END_TEST

START_TEST(the_same_bits_on_many_threads)
{
    static double points[2][2 * MANY];
    feature_mix m;
    mix_create(&m, 8);
    for (int k = 0; k < 2; ++k) {
        const icc_env env = {.size = sizeof env, .threads = k == 0 ? 1 : 3};
        icc_map_info info = {.size = sizeof info};
        icc_map *map = map_of(&m, false, 2, &env);
        (void)icc_map_get_info(map, &info);
        ck_assert_uint_le(info.n_vertices, MANY);
        ck_assert_int_eq(flat_get_mesh(map, NULL, points[k], NULL), ICC_OK);
        icc_map_free(map);
    }
    ck_assert_mem_eq(points[0], points[1], sizeof points[0]);
    mix_free(&m);
}
END_TEST

/* Asks to stop from the report on at which `user` becomes 0. */
static int32_t stop_from(void *user, const char *stage, double share)
{
    int *left = user;
    (void)stage;
    (void)share;
    return --*left <= 0;
}

/* An improvement that is stopped returns the map that it has, although the callback keeps asking to
 * stop while the map is finished. */
START_TEST(stopped_improvements_keep_the_map)
{
    feature_mix m;
    mix_create(&m, 8);
    icc_map *map = map_of(&m, false, -1, NULL), *better;
    int32_t stopped = 1;
    for (int k = 1; stopped; k += k) {
        int left = k;
        const icc_env env = {.size = sizeof env, .user = &left, .progress = stop_from};
        icc_improve_report report = {.size = sizeof report};
        ck_assert_int_eq(icc_map_improve(&better, map, NULL, &report, &env, NULL), ICC_OK);
        ck_assert_double_le(report.energy, report.energy_start);
        stopped = report.cancelled;
        ck_assert_int_eq(stopped, left <= 0);
        icc_map_free(better);
    }
    icc_map_free(map);
    mix_free(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("maps with features");
    TCase *tests = tcase_create("mixes");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, starts);
    tcase_add_test(tests, improved);
    tcase_add_test(tests, the_same_bits_on_many_threads);
    tcase_add_test(tests, stopped_improvements_keep_the_map);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
