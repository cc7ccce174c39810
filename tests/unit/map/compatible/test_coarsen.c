/* Fewer triangles, and better ones: maps stay one-to-one and their boundaries stay. */
#include "base/error.h"
#include "map/compatible/coarsen.h"
#include "map/compatible/flips.h"
#include "map/compatible/triangle_quality.h"

#include "../../../faulty.h"
#include "../../../plmaps.h"
#include "../../../suite.h"

static iccp_plmap shaken(int k, int32_t cells)
{
    const shape s = shape_number(k);
    iccp_plmap map = map_of(&s, cells, wave, 1);
    shake(&map, (uint64_t)k, 0.1);
    return map;
}

/* Inner edges between two vertices of the boundary. */
static size_t count_chords(const iccp_plmap *map)
{
    const uint32_t *v = map->corners.vertex;
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        n += map->corners.twin[c] != ICCP_NO_NEIGHBOUR && map->fixed[v[iccp_after(c)]] &&
             map->fixed[v[iccp_before(c)]];
    return n;
}

static bool is_same_vertex(const iccp_plmap *a, size_t i, const iccp_plmap *b, size_t j)
{
    return memcmp(a->points + 2 * i, b->points + 2 * j, 2 * sizeof *a->points) == 0 &&
           memcmp(a->images + 2 * i, b->images + 2 * j, 2 * sizeof *a->images) == 0 &&
           a->fixed[i] == b->fixed[j] && a->facet[i] == b->facet[j] &&
           !(a->along[i] < b->along[j] || a->along[i] > b->along[j]);
}

/* The vertices that are left are old ones, in their order, with all of the boundary among them. */
static void check_vertices(const iccp_plmap *map, const iccp_plmap *before)
{
    size_t n = 0;
    for (size_t v = 0; v < before->n_vertices; ++v)
        if (n < map->n_vertices && is_same_vertex(map, n, before, v))
            ++n;
        else
            ck_assert(!before->fixed[v]);
    ck_assert_uint_eq(n, map->n_vertices);
}

START_TEST(coarse_maps_are_certified)
{
    const iccp_env env = default_env();
    for (int k = 0; k < N_SHAPES; ++k)
        for (double rise = 0; rise < 20; rise = 4 * rise + 0.3) {
            iccp_plmap map = shaken(k, 10), before, again;
            size_t n_gone, n_again;
            ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
            ck_assert_int_eq(iccp_plmap_copy(&again, &map, &env.memory), ICC_OK);
            ck_assert_int_eq(iccp_coarsen(&map, rise, &n_gone, &env), ICC_OK);
            check_certified(&map);
            ck_assert_uint_gt(n_gone, 0);
            ck_assert_uint_eq(map.n_vertices + n_gone, before.n_vertices);
            ck_assert_uint_eq(map.corners.n_triangles + 2 * n_gone, before.corners.n_triangles);
            ck_assert_uint_eq(count_chords(&map), 0);
            check_vertices(&map, &before);
            ck_assert_double_eq_tol(area_of(&map), area_of(&before), 1e-12 * area_of(&before));
            ck_assert_int_eq(iccp_coarsen(&again, rise, &n_again, &env), ICC_OK);
            ck_assert(is_same(&map, &again));
            iccp_plmap_free(&map);
            iccp_plmap_free(&before);
            iccp_plmap_free(&again);
        }
}
END_TEST

static iccp_quality sum_of(const iccp_plmap *map)
{
    const uint32_t *v = map->corners.vertex;
    iccp_quality all = iccp_no_quality();
    for (size_t t = 0; t < map->corners.n_triangles; ++t)
        iccp_quality_add(&all, map, v[3 * t], v[3 * t + 1], v[3 * t + 2]);
    return all;
}

/* No merge costs more than the vertex is worth. */
START_TEST(worthless_vertices_merge)
{
    const iccp_env env = default_env();
    for (int k = 0; k < N_SHAPES; ++k) {
        size_t most = 0;
        for (double worth = 1e-5; worth < 1; worth *= 10) {
            iccp_plmap map = shaken(k, 10), before;
            size_t n_gone;
            ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
            ck_assert_int_eq(iccp_coarsen_worthless(&map, worth, &n_gone, &env), ICC_OK);
            check_certified(&map);
            check_vertices(&map, &before);
            ck_assert_double_le(sum_of(&map).energy,
                                sum_of(&before).energy + worth * ((double)n_gone + 1e-6));
            most = n_gone > most ? n_gone : most;
            iccp_plmap_free(&map);
            iccp_plmap_free(&before);
        }
        ck_assert_uint_gt(most, 0);
    }
}
END_TEST

/* No vertex of the identity has anything to tell: what stays inside keeps corners of the boundary
 * apart. */
START_TEST(the_identity_becomes_coarse)
{
    const iccp_env env = default_env();
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        iccp_plmap map = map_of(&s, 20, identity, 1);
        size_t n_gone, n_fixed = 0;
        ck_assert_int_eq(iccp_coarsen(&map, 0.3, &n_gone, &env), ICC_OK);
        for (size_t v = 0; v < map.n_vertices; ++v)
            n_fixed += map.fixed[v];
        ck_assert_uint_le(map.n_vertices - n_fixed, n_fixed);
        ck_assert_double_eq_tol(iccp_plmap_energy(&map), 4, 1e-9);
        iccp_plmap_free(&map);
    }
}
END_TEST

/* A hub joins nothing but vertices of the boundary, and may have too many of them. */
START_TEST(hubs_stay)
{
    const iccp_env env = default_env();
    for (uint32_t n = 3; n < 300; n = n < 70 ? n + 1 : 2 * n) {
        iccp_plmap map = wheel(n);
        size_t n_gone;
        check_certified(&map);
        ck_assert_int_eq(iccp_coarsen(&map, 1e9, &n_gone, &env), ICC_OK);
        ck_assert_uint_eq(n_gone, n == 3);
        ck_assert_uint_eq(map.corners.n_triangles, n == 3 ? 1 : n);
        check_certified(&map);
        iccp_plmap_free(&map);
    }
}
END_TEST

START_TEST(flips_lower_the_energy)
{
    const iccp_env env = default_env();
    size_t n_flips = 0;
    for (int k = 0; k < N_SHAPES; ++k) {
        iccp_plmap map = shaken(k, 10), before;
        ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
        size_t n;
        ck_assert_int_eq(iccp_flip_edges(&map, &n, &env), ICC_OK);
        check_certified(&map);
        ck_assert_uint_eq(count_chords(&map), 0);
        check_vertices(&map, &before);
        ck_assert_uint_eq(map.n_vertices, before.n_vertices);
        ck_assert(n == 0 ? is_same(&map, &before)
                         : iccp_plmap_energy(&map) < iccp_plmap_energy(&before));
        n_flips += n;
        iccp_plmap_free(&map);
        iccp_plmap_free(&before);
    }
    ck_assert_uint_gt(n_flips, 20);
}
END_TEST

START_TEST(flips_leave_the_identity_alone)
{
    const iccp_env env = default_env();
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        iccp_plmap map = map_of(&s, 10, identity, 1);
        size_t n;
        ck_assert_int_eq(iccp_flip_edges(&map, &n, &env), ICC_OK);
        ck_assert_uint_eq(n, 0);
        iccp_plmap_free(&map);
    }
}
END_TEST

static icc_status coarsen_copy(const icc_env *env, icc_error *err, void *argument)
{
    iccp_env full;
    iccp_plmap map;
    size_t n_gone;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    icc_status status = iccp_plmap_copy(&map, argument, &full.memory);
    if (status == ICC_OK) {
        status = iccp_coarsen(&map, 0.3, &n_gone, &full);
        check_certified(&map);
        if (status == ICC_OK)
            status = iccp_progress(&full, "improve", 1);
    }
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_valid_maps)
{
    iccp_plmap map = shaken(1, 10);
    faulty_sweep(coarsen_copy, &map);
    iccp_plmap_free(&map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("coarsening");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, coarse_maps_are_certified);
    tcase_add_test(tests, worthless_vertices_merge);
    tcase_add_test(tests, the_identity_becomes_coarse);
    tcase_add_test(tests, hubs_stay);
    tcase_add_test(tests, flips_lower_the_energy);
    tcase_add_test(tests, flips_leave_the_identity_alone);
    tcase_add_test(tests, failures_leave_valid_maps);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
