/* Compatible triangulations: any two polygons with the same number of vertices. */
#include "map/compatible/compatible.h"
#include "math/predicates.h"

#include "../../../hard_shapes.h"
#include "../../../suite.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

/* The mesh has no points inside: only its boundary counts. */
typedef struct pair {
    icc_domain *source, *target;
    iccp_planar base;
    iccp_env env;
    uint32_t *pieces;
} pair;

static pair pair_of(const shape *a, const shape *b)
{
    pair p;
    icc_error err = {.size = sizeof err};
    ck_assert_uint_eq(a->n, b->n);
    ck_assert_int_eq(icc_domain_create(&p.source, 2, a->n, a->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&p.target, 2, b->n, b->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_env_read(&p.env, NULL, NULL), ICC_OK);
    p.pieces = malloc(a->n * sizeof *p.pieces);
    for (size_t f = 0; f < a->n; ++f)
        p.pieces[f] = 1;
    ck_assert_int_eq(iccp_planar_create(&p.base, p.source, p.pieces, 4, &p.env, &err), ICC_OK);
    return p;
}

static void pair_clear(pair *p)
{
    iccp_planar_free(&p->base);
    icc_domain_free(p->source);
    icc_domain_free(p->target);
    free(p->pieces);
}

static icc_status create(iccp_plmap *map, const pair *p, const iccp_env *env)
{
    return iccp_compatible_create(map, &p->base, p->source, p->target->vertices, 1, env);
}

static double area_sum(const iccp_plmap *map, const double *xy)
{
    double sum = 0;
    for (size_t t = 0; t < map->corners.n_triangles; ++t) {
        const uint32_t *v = map->corners.vertex + 3 * t;
        sum +=
            0.5 * iccp_area2d(xy + 2 * (size_t)v[0], xy + 2 * (size_t)v[1], xy + 2 * (size_t)v[2]);
    }
    return sum;
}

/* All triangles positive and their areas sum to the polygon's, before and after; each edge once in
 * each direction, or on the boundary, whose vertices stay. */
static void check_map(const pair *p, const iccp_plmap *map)
{
    const size_t n = p->base.n_boundary, n_triangles = map->corners.n_triangles;
    size_t n_open = 0;
    for (uint32_t t = 0; t < n_triangles; ++t) {
        ck_assert(iccp_plmap_positive_point(map, t));
        ck_assert(iccp_plmap_positive_image(map, t));
    }
    for (uint32_t c = 0; c < 3 * n_triangles; ++c) {
        const uint32_t a = map->corners.vertex[iccp_after(c)];
        const uint32_t b = map->corners.vertex[iccp_before(c)];
        if (map->corners.twin[c] != ICCP_NO_NEIGHBOUR) {
            ck_assert_uint_eq(map->corners.vertex[iccp_after(map->corners.twin[c])], b);
            continue;
        }
        ++n_open;
        ck_assert(a < n && b == (a + 1) % n);
    }
    ck_assert_uint_eq(n_open, n);
    ck_assert_uint_eq(2 * map->n_vertices, n_triangles + n + 2);
    ck_assert_mem_eq(map->points, p->base.points, 2 * n * sizeof(double));
    ck_assert_mem_eq(map->images, p->target->vertices, 2 * n * sizeof(double));
    ck_assert_double_eq_tol(area_sum(map, map->points), p->source->measure,
                            1e-9 * p->source->measure);
    ck_assert_double_eq_tol(area_sum(map, map->images), p->target->measure,
                            1e-9 * p->target->measure);
}

static void check_shapes(const shape *a, const shape *b)
{
    pair p = pair_of(a, b);
    iccp_plmap map;
    ck_assert_int_eq(create(&map, &p, &p.env), ICC_OK);
    check_map(&p, &map);
    iccp_plmap_free(&map);
    pair_clear(&p);
}

START_TEST(test_wild_to_wild)
{
    for (uint64_t seed = 0; seed < 60; ++seed) {
        const size_t n = 3 + (size_t)(seed * seed % 120);
        const shape a = shape_wild(n, seed), b = shape_wild(n, seed + 1000);
        check_shapes(&a, &b);
    }
}
END_TEST

START_TEST(test_hard_to_wild)
{
    for (int k = 0; k < N_HARD_SHAPES; ++k) {
        const shape a = shape_hard(k), b = shape_wild(a.n, 7);
        if (shape_hard_slack(k) > 1e-4)
            continue;
        check_shapes(&a, &b);
        check_shapes(&b, &a);
    }
}
END_TEST

/* The same shape: no diagonals cross, so no point is needed. */
START_TEST(test_same)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape a = shape_number(k);
        pair p = pair_of(&a, &a);
        iccp_plmap map;
        ck_assert_int_eq(create(&map, &p, &p.env), ICC_OK);
        check_map(&p, &map);
        ck_assert_uint_eq(map.n_vertices, a.n);
        iccp_plmap_free(&map);
        pair_clear(&p);
    }
}
END_TEST

/* A band with n vertices, its diagonals across, and the same a quarter of the way round: all cross,
 * n^2 / 4 times. */
START_TEST(test_too_many_crossings)
{
    enum { N = 1200 };
    double band[2 * N], turned[2 * N];
    icc_domain *domains[2];
    iccp_planar base;
    iccp_env env;
    iccp_plmap map;
    uint32_t pieces[N];
    for (size_t k = 0; k < N; ++k) {
        const bool below = k < N / 2;
        band[2 * k] = (double)(below ? k : N - 1 - k);
        band[2 * k + 1] = below ? 0 : 30;
        pieces[k] = 1;
    }
    for (size_t k = 0; k < N; ++k)
        memcpy(turned + 2 * k, band + 2 * ((k + N / 4) % N), 2 * sizeof *band);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(
            icc_domain_create(&domains[k], 2, N, k == 0 ? band : turned, 0, NULL, NULL, NULL),
            ICC_OK);
    ck_assert_int_eq(iccp_planar_create(&base, domains[0], pieces, 4, &env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_compatible_create(&map, &base, domains[0], domains[1]->vertices, 1, &env),
                     ICC_ERR_RESOLUTION);
    iccp_planar_free(&base);
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("compatible triangulations");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, test_wild_to_wild);
    tcase_add_test(tests, test_hard_to_wild);
    tcase_add_test(tests, test_same);
    tcase_add_test(tests, test_too_many_crossings);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
