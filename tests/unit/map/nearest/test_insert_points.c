/* Points inserted into a one-to-one map, also next to its edges and vertices. */
#include "base/error.h"
#include "geometry/frame.h"
#include "map/nearest/insert_points.h"

#include "../../../faulty.h"
#include "../../../plmaps.h"
#include "../../../suite.h"

enum { MOST = 4000 };

static iccp_plmap make_map(void)
{
    const shape square = shape_channel(1);
    return map_of(&square, 5, wave, 1);
}

/* Lists random points, middles of edges, vertices, and neighbours of these within rounding. Returns
 * their number. */
static size_t list_points(double *points, const iccp_plmap *map)
{
    random_source r = {1};
    double low[2], high[2];
    size_t n = 0;
    iccp_frame_bounds(2, map->n_vertices, map->points, low, high);
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles && n + 4 < MOST; ++c) {
        const double *p = iccp_plmap_point(map, c), *q = iccp_plmap_point(map, iccp_after(c));
        if (map->fixed[map->corners.vertex[c]] || map->fixed[map->corners.vertex[iccp_after(c)]])
            continue;
        const double x = 0.5 * p[0] + 0.5 * q[0], y = 0.5 * p[1] + 0.5 * q[1];
        const double at[8] = {p[0], p[1], nextafter(p[0], 2), p[1], x, y, x, nextafter(y, -2)};
        if (iccp_after(c) < c || map->corners.twin[iccp_before(c)] < c)
            continue;
        memcpy(points + 2 * n, at, sizeof at);
        n += 4;
    }
    for (; n < MOST / 2; ++n)
        for (size_t d = 0; d < 2; ++d)
            points[2 * n + d] = random_between(&r, low[d], high[d]);
    return n;
}

static icc_status insert(iccp_plmap *map, size_t n, const double *points, uint32_t *number,
                         bool *is_done, const iccp_env *env)
{
    return iccp_insert_points(map, n, points, number, is_done, env);
}

START_TEST(points_become_vertices)
{
    static double points[2 * MOST];
    static uint32_t number[MOST];
    const iccp_env env = default_env();
    iccp_plmap map = make_map();
    const size_t n_before = map.n_vertices, n = list_points(points, &map);
    bool is_done = false;
    ck_assert_uint_gt(n, 100);
    ck_assert_int_eq(insert(&map, n, points, number, &is_done, &env), ICC_OK);
    ck_assert(is_done);
    check_certified(&map);
    for (size_t i = 0; i < n; ++i)
        ck_assert_int_eq(
            memcmp(map.points + 2 * (size_t)number[i], points + 2 * i, 2 * sizeof *points), 0);
    ck_assert_uint_lt(map.n_vertices, n_before + n);
    size_t n_worse = 0;
    for (uint32_t c = 0; c < 3 * map.corners.n_triangles; ++c)
        n_worse += map.corners.twin[c] != ICCP_NO_NEIGHBOUR && iccp_may_flip_to_delaunay(&map, c);
    ck_assert_uint_le(100 * n_worse, map.corners.n_triangles);
    iccp_plmap_free(&map);
}
END_TEST

/* New vertices lie where the map takes them, or hardly away if rounding is in the way. */
START_TEST(images_are_those_of_the_map)
{
    static double points[2 * MOST];
    static uint32_t number[MOST];
    const iccp_env env = default_env();
    const shape square = shape_channel(1);
    iccp_plmap map = map_of(&square, 5, identity, 1);
    const size_t n = list_points(points, &map);
    bool is_done;
    ck_assert_int_eq(insert(&map, n, points, number, &is_done, &env), ICC_OK);
    ck_assert(is_done);
    for (size_t v = 0; v < 2 * map.n_vertices; ++v)
        ck_assert_double_eq_tol(map.images[v], map.points[v], 1e-3);
    iccp_plmap_free(&map);
}
END_TEST

static icc_status make_and_free(const icc_env *env, icc_error *err, void *argument)
{
    const double *points = argument;
    uint32_t number[50];
    iccp_plmap map = make_map(), own;
    iccp_env full;
    bool is_done;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    icc_status status = iccp_plmap_copy(&own, &map, &full.memory);
    if (status == ICC_OK) {
        status = insert(&own, 50, points, number, &is_done, &full);
        iccp_plmap_free(&own);
    }
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing_behind)
{
    static double points[2 * MOST];
    iccp_plmap map = make_map();
    (void)list_points(points, &map);
    iccp_plmap_free(&map);
    faulty_sweep(make_and_free, points);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("inserted points");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, points_become_vertices);
    tcase_add_test(tests, images_are_those_of_the_map);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
