/* Starts without cuts: found where features move little, refused where they do not. */
#include "map/plane/straight_start.h"

#include "map/compatible/network_rows.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../random.h"
#include "../../../suite.h"

#include <check.h>

static const double SQUARE[8] = {0, 0, 1, 0, 1, 1, 0, 1};

enum { MOST = 400 };

static icc_domain *square_with(size_t n, const double *points)
{
    icc_feature features[MOST];
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    for (size_t k = 0; k < n; ++k)
        features[k] = (icc_feature){.size = sizeof *features,
                                    .kind = ICC_FEATURE_POINT,
                                    .n_vertices = 1,
                                    .vertices = points + 2 * k};
    if (icc_domain_create_features(&domain, 4, SQUARE, n, features, NULL, &err) != ICC_OK)
        ck_abort_msg("%s", err.message);
    return domain;
}

typedef struct pair {
    icc_domain *domain[2];
} pair;

static void pair_free(pair *p)
{
    icc_domain_free(p->domain[0]);
    icc_domain_free(p->domain[1]);
}

/* A lattice of points that each move by at most so many cells from their places in it, in the source
 * and in the target. */
static pair lattice(size_t side, double cells, uint64_t seed)
{
    static double points[2][2 * MOST];
    random_source r = {seed};
    for (int k = 0; k < 2; ++k)
        for (size_t i = 0; i < 2 * side * side; ++i) {
            const size_t cell = i % 2 == 0 ? i / 2 % side : i / 2 / side;
            points[k][i] = ((double)cell + 0.5 + random_between(&r, -cells, cells)) / (double)side;
        }
    return (pair){{square_with(side * side, points[0]), square_with(side * side, points[1])}};
}

/* Looks for a start, and checks the one that is found. Returns whether there is one. */
static bool is_found(const pair *p, size_t *n_vertices)
{
    const iccp_env env = default_env();
    iccp_domain_pair scene;
    iccp_plmap map;
    iccp_cuts tree;
    iccp_work work = iccp_work_unlimited();
    bool found, follows = false;
    ck_assert_int_eq(iccp_domain_pair_create(&scene, p->domain[0], p->domain[1], &env), ICC_OK);
    ck_assert_int_eq(iccp_straight_start(&map, &tree, &found, &scene, &work, &env), ICC_OK);
    if (found) {
        ck_assert(iccp_plmap_is_positive(&map));
        ck_assert_int_eq(iccp_check_rows(&follows, &map, p->domain[1], &env), ICC_OK);
        ck_assert(follows);
        ck_assert_uint_eq(tree.n, scene.n_cuts);
        ck_assert_uint_eq(tree.first[tree.n], 0);
        *n_vertices = map.n_vertices;
    }
    iccp_plmap_free(&map);
    iccp_cuts_free(&tree);
    iccp_domain_pair_free(&scene);
    return found;
}

START_TEST(points_that_move_little)
{
    for (size_t side = 2; side <= 20; side += 3) {
        pair p = lattice(side, 0.1, side);
        size_t n;
        ck_assert(is_found(&p, &n));
        ck_assert_uint_gt(n, side * side + 4); /* the square's sides are halved */
        pair_free(&p);
    }
}
END_TEST

START_TEST(some_triangles_are_mended)
{
    int n_found = 0;
    for (uint64_t seed = 0; seed < 20; ++seed) {
        pair p = lattice(7, 0.25, seed);
        size_t n;
        n_found += is_found(&p, &n);
        pair_free(&p);
    }
    ck_assert_int_ge(n_found, 15);
    for (uint64_t seed = 0; seed < 300; ++seed) { /* patches grow into one another */
        pair p = lattice(2 + seed % 4, 0.45, seed);
        size_t n;
        (void)is_found(&p, &n);
        pair_free(&p);
    }
}
END_TEST

START_TEST(points_that_change_places)
{
    double points[2][200];
    for (size_t i = 0; i < 100; ++i)
        for (size_t k = 0; k < 2; ++k) {
            const size_t j = k == 0 ? i : 37 * i % 100;
            points[k][2 * i] = (double)(j % 10) / 10 + 0.05;
            points[k][2 * i + 1] = (double)(j / 10) / 10 + 0.05;
        }
    pair p = {{square_with(100, points[0]), square_with(100, points[1])}};
    size_t n;
    ck_assert(!is_found(&p, &n));
    pair_free(&p);
}
END_TEST

/* Half-way all points are in one place, so the source is triangulated. */
START_TEST(half_a_turn)
{
    const double before[4] = {0.4, 0.5, 0.6, 0.5}, after[4] = {0.6, 0.5, 0.4, 0.5};
    pair p = {{square_with(2, before), square_with(2, after)}};
    size_t n;
    (void)is_found(&p, &n);
    pair_free(&p);
}
END_TEST

static icc_status make(const icc_env *given, icc_error *err, void *argument)
{
    const pair *p = argument;
    icc_map *map;
    const icc_map_options options = {.size = sizeof options, .iterations = -1};
    const icc_status status =
        icc_map_create(&map, p->domain[0], p->domain[1], &options, given, err);
    if (status == ICC_OK)
        icc_map_free(map);
    return status;
}

START_TEST(every_allocation_may_fail)
{
    pair p = lattice(5, 0.25, 1);
    size_t n;
    ck_assert(is_found(&p, &n));
    faulty_sweep(make, &p);
    pair_free(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("starts without cuts");
    TCase *tcase = tcase_create("starts");
    tcase_set_timeout(tcase, 60);
    tcase_add_test(tcase, points_that_move_little);
    tcase_add_test(tcase, some_triangles_are_mended);
    tcase_add_test(tcase, points_that_change_places);
    tcase_add_test(tcase, half_a_turn);
    tcase_add_test(tcase, every_allocation_may_fail);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
