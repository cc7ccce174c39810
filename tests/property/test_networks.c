/* Maps of random networks: features that share vertices, dead ends, several pieces, holes that
 * touch, and points. */
#include "../flat_mesh.h"
#include "../random_networks.h"
#include "../share.h"
#include "../suite.h"

#include <check.h>
#include <stdio.h>
#include <time.h>

enum { N_NETWORKS = 1000, N_IMPROVED = 20, MOST_POINTS = 120, MANY_POINTS = 1600 };

/* Every vertex goes to its partner, exactly in its own coordinates up to one rounding. */
static void check_vertices(const random_network *w, const icc_map *map)
{
    double *images = malloc(2 * w->n_given * sizeof *images);
    ck_assert_int_eq(icc_map_apply(map, w->n_given, w->given[0], images, NULL, NULL, NULL), ICC_OK);
    for (size_t k = 0; k < 2 * w->n_given; ++k)
        ck_assert_double_eq_tol(images[k], w->given[1][k], 1e-15);
    free(images);
}

/* Returns false if rounding prevents a map. Any other error fails the test. */
static bool check_network(uint64_t seed, size_t n, int32_t iterations)
{
    random_network w;
    network_create(&w, seed, n);
    ck_assert_msg(w.domain[1] != NULL, "seed %d: %s", (int)seed, w.error.message);
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_map *map;
    const icc_status status =
        icc_map_create(&map, w.domain[0], w.domain[1], &options, NULL, &w.error);
    if (status == ICC_OK) {
        icc_map_info info = {.size = sizeof info};
        (void)icc_map_get_info(map, &info);
        ck_assert_msg(info.certified == 1, "seed %d", (int)seed);
        ck_assert_msg(info.class_kept == 1, "seed %d", (int)seed);
        check_vertices(&w, map);
    } else {
        ck_assert_msg(status == ICC_ERR_RESOLUTION, "seed %d: %s", (int)seed, w.error.message);
    }
    icc_map_free(map);
    network_free(&w);
    return status == ICC_OK;
}

static size_t size_of(int k)
{
    return 1 + (size_t)(k * 37 % MOST_POINTS);
}

START_TEST(starts)
{
    int n_refused = 0;
    for (int k = 0; k < share_of(N_NETWORKS); ++k)
        n_refused += !check_network((uint64_t)k, size_of(k), -1);
    ck_assert_int_le(100 * n_refused, share_of(N_NETWORKS));
}
END_TEST

START_TEST(improved)
{
    for (int k = 0; k < share_of(N_IMPROVED); ++k)
        ck_assert(check_network((uint64_t)(N_NETWORKS + k), size_of(k), 0));
}
END_TEST

START_TEST(the_same_bits_on_many_threads)
{
    random_network w;
    double *images[2];
    size_t n[2];
    network_create(&w, 4, MOST_POINTS);
    for (int k = 0; k < 2; ++k) {
        const icc_env env = {.size = sizeof env, .threads = k == 0 ? 1 : 3};
        icc_map_info info = {.size = sizeof info};
        icc_map *map;
        ck_assert_int_eq(icc_map_create(&map, w.domain[0], w.domain[1], NULL, &env, NULL), ICC_OK);
        (void)icc_map_get_info(map, &info);
        n[k] = info.n_vertices;
        images[k] = malloc(2 * n[k] * sizeof **images);
        ck_assert_int_eq(flat_get_mesh(map, NULL, images[k], NULL), ICC_OK);
        icc_map_free(map);
    }
    ck_assert_uint_eq(n[0], n[1]);
    ck_assert_mem_eq(images[0], images[1], 2 * n[0] * sizeof **images);
    free(images[0]);
    free(images[1]);
    network_free(&w);
}
END_TEST

/* About 3,000 faces. */
START_TEST(many_faces)
{
    for (uint64_t seed = 0; seed < 2; ++seed)
        ck_assert(check_network(seed, MANY_POINTS, -1));
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("networks");
    TCase *tests = tcase_create("random");
    tcase_set_timeout(tests, 240);
    tcase_add_test(tests, starts);
    tcase_add_test(tests, improved);
    tcase_add_test(tests, the_same_bits_on_many_threads);
    tcase_add_test(tests, many_faces);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
