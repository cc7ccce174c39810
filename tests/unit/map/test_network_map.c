/* Maps between domains whose features meet: made, saved, inverted, retargeted, improved. */
#include "../../domains.h"
#include "../../feature_pairs.h"
#include "../../saved.h"
#include "../../suite.h"
#include "domain/network.h"
#include "map/compatible/coarsen.h"
#include "map/compatible/triangle_quality.h"
#include "map/map.h"
#include "map/plane/plane_kind.h"

/* Rings and lines of the plans. */
static void rivers(plan *p)
{
    *p = plan_square(8);
    plan_feature(p, ICC_FEATURE_HOLE, 4, (const double[]){3, 3, 4, 2, 5, 3, 4, 4});
    plan_feature(p, ICC_FEATURE_LINE, 3, (const double[]){0, 0, 2, 1, 3, 3});
    plan_feature(p, ICC_FEATURE_LINE, 3, (const double[]){5, 3, 6.5, 3.5, 8, 8});
    plan_feature(p, ICC_FEATURE_LINE, 2, (const double[]){6.5, 3.5, 6, 1});
    plan_point(p, 2, 6);
}

/* A hole touches the outer ring at a corner, and another hole. */
static void holes_that_touch(plan *p)
{
    *p = plan_square(8);
    plan_feature(p, ICC_FEATURE_HOLE, 3, (const double[]){0, 0, 3, 1, 2, 3});
    plan_feature(p, ICC_FEATURE_HOLE, 4, (const double[]){3, 1, 5, 1, 6, 3, 4, 4});
    plan_feature(p, ICC_FEATURE_LINE, 2, (const double[]){2, 3, 4, 4});
    plan_point(p, 6, 6);
}

/* Closed lines share a side, and a third one only a vertex. One vertex is given twice. */
static void cells(plan *p)
{
    *p = plan_square(8);
    plan_feature(p, ICC_FEATURE_LINE, 5, (const double[]){1, 1, 3, 1, 3, 3, 1, 3, 1, 1});
    plan_feature(p, ICC_FEATURE_LINE, 5, (const double[]){3, 1, 5, 1, 5, 3, 3, 3, 3, 1});
    plan_feature(p, ICC_FEATURE_LINE, 4, (const double[]){5, 3, 7, 4, 6, 6, 5, 3});
    plan_point(p, 1, 3);
}

/* An island in a lake touches its shore, and a road crosses it. */
static void island(plan *p)
{
    *p = plan_square(8);
    plan_feature(p, ICC_FEATURE_HOLE, 4, (const double[]){1, 1, 7, 1, 7, 7, 1, 7});
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){7, 7, 3, 6, 3, 3, 6, 3});
    plan_feature(p, ICC_FEATURE_LINE, 2, (const double[]){3, 6, 6, 3});
}

/* No outer ring: two parts that share a side, and one apart with a hole. */
static void parts(plan *p)
{
    *p = (plan){.n_outer = 0};
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){0, 0, 3, 0, 3, 3, 0, 3});
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){3, 0, 6, 0, 6, 3, 3, 3});
    plan_feature(p, ICC_FEATURE_REGION, 4, (const double[]){8, 0, 12, 0, 12, 4, 8, 4});
    plan_feature(p, ICC_FEATURE_HOLE, 3, (const double[]){9, 1, 9, 2, 10, 2});
}

static void (*const MAKE[])(plan *) = {rivers, holes_that_touch, cells, island, parts};
enum { N_NETWORKS = sizeof MAKE / sizeof *MAKE };

static plan bent(const plan *p, double amount)
{
    plan moved = *p;
    for (size_t v = 0; v < p->n_vertices; ++v) {
        const double x = p->xy[2 * v], y = p->xy[2 * v + 1];
        moved.xy[2 * v] = x + amount * sin(0.7 * y);
        moved.xy[2 * v + 1] = 0.9 * y - amount * sin(0.5 * x);
    }
    return moved;
}

static icc_map *map_between(const icc_domain *source, const icc_domain *target, int32_t iterations)
{
    const icc_map_options options = {.size = sizeof options, .iterations = iterations};
    icc_map *map;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, source, target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return map;
}

/* All vertices of one side go to those of the other. */
static void check_vertices(const icc_map *map, bool inverse, const plan *from, const plan *to)
{
    double image[2];
    for (size_t v = 0; v < from->n_vertices; ++v) {
        const icc_status status =
            inverse ? icc_map_apply_inverse(map, 1, from->xy + 2 * v, image, NULL, NULL, NULL)
                    : icc_map_apply(map, 1, from->xy + 2 * v, image, NULL, NULL, NULL);
        ck_assert_int_eq(status, ICC_OK);
        for (int k = 0; k < 2; ++k)
            ck_assert_double_eq_tol(image[k], to->xy[2 * v + (size_t)k], 1e-13);
    }
}

/* Points of all facets keep their share of the facet. */
static void check_facets(const icc_map *map, const plan *from, const plan *to)
{
    const icc_domain *source = map->source_domain;
    for (size_t f = 0; f < source->features->n_places; ++f) {
        const size_t a = 2 * (size_t)source->facets[2 * f],
                     b = 2 * (size_t)source->facets[2 * f + 1];
        for (double share = 0.1; share < 1; share += 0.27) {
            double point[2], image[2];
            for (size_t k = 0; k < 2; ++k)
                point[k] = from->xy[a + k] + share * (from->xy[b + k] - from->xy[a + k]);
            ck_assert_int_eq(icc_map_apply(map, 1, point, image, NULL, NULL, NULL), ICC_OK);
            for (size_t k = 0; k < 2; ++k)
                ck_assert_double_eq_tol(
                    image[k], to->xy[a + k] + share * (to->xy[b + k] - to->xy[a + k]), 1e-11);
        }
    }
}

static void check_round_trip(const icc_map *map, const icc_domain *source)
{
    random_source r = {3};
    for (int i = 0; i < 200; ++i) {
        double point[2], image[2], back[2];
        domain_random_point(&r, source, point);
        ck_assert_int_eq(icc_map_apply(map, 1, point, image, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_map_apply_inverse(map, 1, image, back, NULL, NULL, NULL), ICC_OK);
        for (int k = 0; k < 2; ++k)
            ck_assert_double_eq_tol(back[k], point[k], 1e-9);
    }
}

static void check_saved(const icc_map *map, const icc_domain *source)
{
    bytes b = map_bytes(map);
    icc_map *loaded;
    ck_assert_int_eq(b.data[8], 4);
    ck_assert_int_eq(icc_map_load(&loaded, b.n, b.data, NULL, NULL), ICC_OK);
    same_map(map, loaded, source);
    bytes again = map_bytes(loaded);
    ck_assert_uint_eq(again.n, b.n);
    ck_assert_same(again.data, b.data, b.n, "what is saved again");
    free(b.data);
    free(again.data);
    icc_map_free(loaded);
}

static void check_map(const icc_map *map, const plan *from, const plan *to)
{
    ck_assert_int_eq(info_of_map(map).certified, 1);
    check_vertices(map, false, from, to);
    check_vertices(map, true, to, from);
    check_facets(map, from, to);
    check_round_trip(map, map->source_domain);
    check_saved(map, map->source_domain);
}

START_TEST(maps)
{
    plan source, target;
    MAKE[_i](&source);
    target = bent(&source, 0.4);
    icc_domain *d[2] = {plan_domain(&source), plan_domain(&target)};
    for (int swapped = 0; swapped < 2; ++swapped)
        for (int32_t iterations = -1; iterations < 1; ++iterations) {
            icc_map *map = map_between(d[swapped], d[!swapped], iterations);
            check_map(map, swapped ? &target : &source, swapped ? &source : &target);
            icc_map_free(map);
        }
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

START_TEST(maps_that_go_on)
{
    plan source, target;
    MAKE[_i](&source);
    target = bent(&source, 0.4);
    const plan further = bent(&source, 0.6);
    icc_domain *d[3] = {plan_domain(&source), plan_domain(&target), plan_domain(&further)};
    icc_map *map = map_between(d[0], d[1], 0), *better, *next;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_map_improve(&better, map, NULL, NULL, NULL, &err), ICC_OK);
    ck_assert_double_le(info_of_map(better).energy, info_of_map(map).energy * (1 + 1e-12));
    check_map(better, &source, &target);
    ck_assert_msg(icc_map_retarget(&next, map, d[2], NULL, NULL, &err) == ICC_OK, "%s",
                  err.message);
    check_map(next, &source, &further);
    ck_assert_int_eq(info_of_map(next).class_kept, 1);
    icc_map_free(next);
    icc_map_free(better);
    icc_map_free(map);
    for (int k = 0; k < 3; ++k)
        icc_domain_free(d[k]);
}
END_TEST

START_TEST(mirrored_maps)
{
    plan source, target;
    MAKE[_i](&source);
    target = bent(&source, 0.2);
    for (size_t v = 0; v < source.n_vertices; ++v) {
        source.xy[2 * v] = -source.xy[2 * v];
        target.xy[2 * v] = -target.xy[2 * v];
    }
    icc_domain *d[2] = {plan_domain(&source), plan_domain(&target)};
    icc_map *map = map_between(d[0], d[1], -1);
    check_map(map, &source, &target);
    icc_map_free(map);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

/* A refinement that gains less than 1 % by cutting a fifth of the triangles is in vain. So hardly
 * any vertex can be merged that is worth less than its part of that. */
START_TEST(worthless_vertices_are_gone)
{
    plan source, target;
    MAKE[_i](&source);
    target = bent(&source, 0.6);
    icc_domain *d[2] = {plan_domain(&source), plan_domain(&target)};
    icc_map *map = map_between(d[0], d[1], 0);
    const icc_env quiet = {.size = sizeof quiet};
    iccp_env env;
    iccp_plmap pl;
    size_t n_gone;
    ck_assert_int_eq(iccp_env_read(&env, &quiet, NULL), ICC_OK);
    ck_assert_int_eq(iccp_plmap_copy(&pl, &iccp_plane_of(map)->pl, &env.memory), ICC_OK);
    iccp_quality all = iccp_no_quality();
    const uint32_t *v = pl.corners.vertex;
    for (size_t t = 0; t < pl.corners.n_triangles; ++t)
        iccp_quality_add(&all, &pl, v[3 * t], v[3 * t + 1], v[3 * t + 2]);
    const double worth = 0.01 * all.energy / (0.2 * (double)pl.corners.n_triangles);
    const size_t n = pl.n_vertices;
    ck_assert_int_eq(iccp_coarsen_worthless(&pl, worth, &n_gone, &env), ICC_OK);
    ck_assert_uint_le(100 * n_gone, 2 * n);
    iccp_plmap_free(&pl);
    icc_map_free(map);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

/* The certificate of a whole map notices what no triangle shows. */
START_TEST(certificates)
{
    plan source, target;
    MAKE[_i](&source);
    target = bent(&source, 0.4);
    icc_domain *d[2] = {plan_domain(&source), plan_domain(&target)};
    icc_map *map = map_between(d[0], d[1], 0);
    const icc_env quiet = {.size = sizeof quiet};
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, &quiet, NULL), ICC_OK);
    const iccp_plmap *pl = &iccp_plane_of(map)->pl;
    for (uint32_t v = 0; v < pl->n_vertices; v += 7) {
        double *const moved[] = {pl->points + 2 * (size_t)v, pl->images + 2 * (size_t)v};
        for (int k = 0; k < 2 && pl->fixed[v] != ICCP_FREE; ++k) {
            const double before = *moved[k];
            *moved[k] += 1e-7;
            ck_assert_int_eq(map->kind->certify(map, &env, NULL), ICC_ERR_CERTIFICATE);
            *moved[k] = before;
        }
    }
    ck_assert_int_eq(map->kind->certify(map, &env, NULL), ICC_OK);
    icc_map_free(map);
    icc_domain_free(d[0]);
    icc_domain_free(d[1]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("network map");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_loop_test(tests, maps, 0, N_NETWORKS);
    tcase_add_loop_test(tests, maps_that_go_on, 0, N_NETWORKS);
    tcase_add_loop_test(tests, mirrored_maps, 0, N_NETWORKS);
    tcase_add_loop_test(tests, worthless_vertices_are_gone, 0, N_NETWORKS);
    tcase_add_loop_test(tests, certificates, 0, N_NETWORKS);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
