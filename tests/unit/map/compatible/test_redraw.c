/* Patches that cannot be untangled as they are joined are drawn anew; all round them stays. */
#include "base/error.h"
#include "map/compatible/redraw.h"

#include "../../../faulty.h"
#include "../../../plmaps.h"
#include "../../../suite.h"

/* Images of a few inner vertices change places, by turns: each with one three edges away. */
static iccp_plmap tangled(int k, size_t n_swaps)
{
    const shape s = shape_number(k);
    iccp_plmap map = map_of(&s, 14, wave, 1);
    random_source r = {(uint64_t)k};
    for (size_t n = 0; n < n_swaps; ++n) {
        uint32_t c = (uint32_t)random_between(&r, 0, 3 * (double)map.corners.n_triangles);
        const uint32_t a = map.corners.vertex[c];
        for (int step = 0; step < 3 && map.corners.twin[c] != ICCP_NO_NEIGHBOUR; ++step)
            c = iccp_after(map.corners.twin[c]);
        const uint32_t b = map.corners.vertex[c];
        if (map.fixed[a] || map.fixed[b])
            continue;
        for (size_t d = 0; d < 2; ++d) {
            const double swap = map.images[2 * (size_t)a + d];
            map.images[2 * (size_t)a + d] = map.images[2 * (size_t)b + d];
            map.images[2 * (size_t)b + d] = swap;
        }
    }
    return map;
}

static size_t redraw(iccp_plmap *map)
{
    const iccp_env env = default_env();
    iccp_work work = iccp_work_unlimited();
    size_t n_left;
    ck_assert_int_eq(iccp_redraw(map, &work, &n_left, &env), ICC_OK);
    ck_assert_uint_eq(n_left, iccp_plmap_count_inverted(map));
    return n_left;
}

/* Vertices of the boundary, in the order that they have. */
static size_t count_same_boundary(const iccp_plmap *map, const iccp_plmap *before)
{
    size_t n = 0, v = 0;
    for (size_t w = 0; w < before->n_vertices; ++w) {
        if (!before->fixed[w])
            continue;
        while (v < map->n_vertices && !map->fixed[v])
            ++v;
        if (v == map->n_vertices)
            break;
        n += memcmp(map->points + 2 * v, before->points + 2 * w, 2 * sizeof *map->points) == 0 &&
             memcmp(map->images + 2 * v, before->images + 2 * w, 2 * sizeof *map->images) == 0 &&
             map->facet[v] == before->facet[w];
        ++v;
    }
    return n;
}

START_TEST(tangled_patches_are_drawn_anew)
{
    const iccp_env env = default_env();
    size_t n_tangled = 0;
    for (int k = 0; k < N_SHAPES; ++k) {
        iccp_plmap map = tangled(k, 4), before;
        size_t n_fixed = 0;
        ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
        for (size_t v = 0; v < map.n_vertices; ++v)
            n_fixed += map.fixed[v] != ICCP_FREE;
        n_tangled += iccp_plmap_count_inverted(&map) > 0;
        ck_assert_uint_eq(redraw(&map), 0);
        check_certified(&map);
        ck_assert_uint_eq(count_same_boundary(&map, &before), n_fixed);
        ck_assert_double_eq_tol(area_of(&map), area_of(&before), 1e-12 * area_of(&before));
        iccp_plmap_free(&before);
        iccp_plmap_free(&map);
    }
    ck_assert_uint_gt(n_tangled, N_SHAPES / 2);
}
END_TEST

START_TEST(what_is_positive_stays)
{
    const iccp_env env = default_env();
    for (int k = 0; k < N_SHAPES; ++k) {
        iccp_plmap map = tangled(k, 0), before;
        ck_assert_int_eq(iccp_plmap_copy(&before, &map, &env.memory), ICC_OK);
        ck_assert_uint_eq(redraw(&map), 0);
        ck_assert(is_same(&map, &before));
        iccp_plmap_free(&before);
        iccp_plmap_free(&map);
    }
}
END_TEST

/* A wheel whose rim goes to another polygon. */
static iccp_plmap fan(const shape *to)
{
    iccp_plmap map = wheel((uint32_t)to->n);
    memcpy(map.images, to->xy, 2 * to->n * sizeof *map.images);
    return map;
}

/* There is no place for the vertex in the middle from which all can be seen. */
static iccp_plmap fan_to_spiral(size_t pieces)
{
    const shape spiral = shape_spiral(pieces, 1.5);
    return fan(&spiral);
}

START_TEST(a_vertex_has_no_place)
{
    for (size_t pieces = 10; pieces < 49; pieces = 2 * pieces + 1) {
        iccp_plmap map = fan_to_spiral(pieces);
        ck_assert_uint_gt(iccp_plmap_count_inverted(&map), 0);
        ck_assert_uint_eq(redraw(&map), 0);
        check_certified(&map);
        iccp_plmap_free(&map);
    }
}
END_TEST

static void check_stays(iccp_plmap *map)
{
    const iccp_env env = default_env();
    iccp_plmap before;
    ck_assert_int_eq(iccp_plmap_copy(&before, map, &env.memory), ICC_OK);
    ck_assert_uint_gt(redraw(map), 0);
    ck_assert(is_same(map, &before));
    iccp_plmap_free(&before);
    iccp_plmap_free(map);
}

/* A point inside has to stay, a border with many corners is none of a small patch, and one that
 * turns over or crosses itself has no map. */
START_TEST(what_cannot_be_drawn_stays)
{
    const shape square = shape_of(4, (double[]){0, 0, 0, 1, 1, 1, 1, 0}),
                bow = shape_of(4, (double[]){0, 0, 1, 1, 1, 0, 0, 1});
    iccp_plmap map = fan_to_spiral(10);
    map.fixed[map.n_vertices - 1] = ICCP_ON_POINT;
    check_stays(&map);
    map = fan_to_spiral(60);
    check_stays(&map);
    map = fan(&square);
    check_stays(&map);
    map = fan(&bow);
    check_stays(&map);
}
END_TEST

static icc_status redraw_copy(const icc_env *env, icc_error *err, void *argument)
{
    iccp_env full;
    iccp_plmap map;
    iccp_work work = iccp_work_unlimited();
    size_t n_left;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    icc_status status = iccp_plmap_copy(&map, argument, &full.memory);
    if (status == ICC_OK) {
        status = iccp_redraw(&map, &work, &n_left, &full);
        check_mesh(&map);
        if (status == ICC_OK)
            status = iccp_progress(&full, "repair", 1);
    }
    iccp_plmap_free(&map);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_valid_meshes)
{
    const shape dart = shape_of(4, (double[]){1, 0, 0, 3, -1, 0, 0, 1});
    iccp_plmap map = fan(&dart);
    ck_assert_uint_gt(iccp_plmap_count_inverted(&map), 0);
    faulty_sweep(redraw_copy, &map);
    iccp_plmap_free(&map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("drawing patches anew");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, tangled_patches_are_drawn_anew);
    tcase_add_test(tests, what_is_positive_stays);
    tcase_add_test(tests, a_vertex_has_no_place);
    tcase_add_test(tests, what_cannot_be_drawn_stays);
    tcase_add_test(tests, failures_leave_valid_meshes);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
