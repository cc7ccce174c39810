/* The nearest map with a boundary that may move. */
#include "base/error.h"
#include "map/nearest/nearest.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../suite.h"
#include "../../../warps.h"

#include <icc/fit.h>

/* Makes a map of a lattice, with its triangles counter-clockwise. */
static iccp_plmap map_of_warp(const warp *w, const iccp_env *env)
{
    iccp_plmap map;
    bool is_manifold = false;
    ck_assert_int_eq(iccp_plmap_begin(&map, w->n_vertices, w->n_triangles, 1, &env->memory),
                     ICC_OK);
    memcpy(map.points, w->points, 2 * w->n_vertices * sizeof *w->points);
    memcpy(map.images, w->images, 2 * w->n_vertices * sizeof *w->images);
    memcpy(map.corners.vertex, w->triangles, 3 * w->n_triangles * sizeof *w->triangles);
    for (uint32_t t = 0; t < w->n_triangles; ++t)
        if (!iccp_plmap_positive_point(&map, t)) {
            map.corners.vertex[3 * t] = w->triangles[3 * t + 1];
            map.corners.vertex[3 * t + 1] = w->triangles[3 * t];
        }
    ck_assert_int_eq(iccp_find_twins(&map.corners, w->n_vertices, &is_manifold, env), ICC_OK);
    ck_assert(is_manifold);
    for (uint32_t v = 0; v < w->n_vertices; ++v) {
        map.fixed[v] = warp_fade(w->points + 2 * (size_t)v) > 0 ? ICCP_FREE : ICCP_ALONG;
        map.facet[v] = v;
        map.along[v] = 0;
    }
    for (size_t k = 0; k < w->n_held; ++k)
        map.fixed[w->held[k]] = ICCP_ON_POINT;
    return map;
}

/* The square is pinched so much that its sides cross. Two vertices are held. */
static warp pinched(size_t n)
{
    warp w = warp_lattice(n, 0);
    for (size_t v = 0; v < w.n_vertices; ++v) {
        const double x = w.points[2 * v], y = w.points[2 * v + 1];
        w.images[2 * v] = 0.5 + (x - 0.5) * (1 - 1.6 * exp(-40 * (y - 0.5) * (y - 0.5)));
    }
    w.n_held = 2;
    w.held[0] = warp_nearest_vertex(&w, 0.4, 0.5);
    w.held[1] = warp_nearest_vertex(&w, 0.6, 0.6);
    return w;
}

/* The edges of the boundary stay, and vertices keep their numbers. */
static void check_map(const warp *w, const iccp_plmap *map)
{
    size_t n_open = 0;
    ck_assert(iccp_plmap_is_positive(map));
    ck_assert_uint_ge(map->n_vertices, w->n_vertices);
    ck_assert_int_eq(memcmp(map->points, w->points, 2 * w->n_vertices * sizeof *w->points), 0);
    for (size_t k = 0; k < w->n_held; ++k)
        ck_assert_int_eq(memcmp(map->images + 2 * (size_t)w->held[k],
                                w->images + 2 * (size_t)w->held[k], 2 * sizeof(double)),
                         0);
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.twin[c] == ICCP_NO_NEIGHBOUR) {
            ++n_open;
            ck_assert(map->fixed[map->corners.vertex[iccp_after(c)]] == ICCP_ALONG);
        }
    ck_assert_uint_eq(n_open, 4 * w->n);
}

START_TEST(crossing_frame_moves)
{
    const iccp_env env = default_env();
    warp w = pinched(20);
    iccp_plmap map = map_of_warp(&w, &env);
    iccp_nearest_facts facts;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(iccp_nearest(&map, false, &facts, &env, &err), ICC_ERR_BOUNDARY);
    ck_assert(err.message[0] != '\0');
    ck_assert_int_eq(iccp_nearest(&map, true, &facts, &env, &err), ICC_OK);
    check_map(&w, &map);
    ck_assert_int_eq(facts.repair, ICC_REPAIR_WHOLE);
    ck_assert_uint_gt(facts.n_folded, 0);
    ck_assert_uint_eq(facts.n_patches, 1);
    iccp_plmap_free(&map);
    warp_free(&w);
}
END_TEST

/* A fold at the frame, whose image does not cross itself. Far away nothing moves. */
START_TEST(fold_at_the_frame)
{
    const iccp_env env = default_env();
    warp w = warp_lattice(40, 0);
    for (size_t v = 0; v < w.n_vertices; ++v) {
        const double x = w.points[2 * v], y = w.points[2 * v + 1] - 0.5;
        w.images[2 * v] = x - 0.12 * exp(-200 * ((x - 0.1) * (x - 0.1) + y * y));
    }
    iccp_plmap map = map_of_warp(&w, &env);
    iccp_nearest_facts facts;
    ck_assert_int_eq(iccp_nearest(&map, true, &facts, &env, NULL), ICC_OK);
    check_map(&w, &map);
    ck_assert_int_eq(facts.repair, ICC_REPAIR_PATCHES);
    for (size_t v = 0; v < w.n_vertices; ++v)
        ck_assert(w.points[2 * v] < 0.6 ||
                  memcmp(map.images + 2 * v, w.images + 2 * v, 2 * sizeof(double)) == 0);
    iccp_plmap_free(&map);
    warp_free(&w);
}
END_TEST

static icc_status make_and_free(const icc_env *env, icc_error *err, void *argument)
{
    const iccp_env quiet = default_env();
    iccp_plmap map = map_of_warp(argument, &quiet), own = {0};
    iccp_env full;
    iccp_nearest_facts facts;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    icc_status status = iccp_plmap_copy(&own, &map, &full.memory);
    if (status == ICC_OK) {
        status = iccp_nearest(&own, true, &facts, &full, err);
        iccp_plmap_free(&own);
    }
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing_behind)
{
    warp w = pinched(8);
    faulty_sweep(make_and_free, &w);
    warp_free(&w);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("nearest map with a moving frame");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, crossing_frame_moves);
    tcase_add_test(tests, fold_at_the_frame);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
