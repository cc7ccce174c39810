/* The one-to-one map nearest to a warp. */
#include "../flat_mesh.h"
#include "math/predicates.h"

#include "../faulty.h"
#include "../suite.h"
#include "../warps.h"

#include <icc/fit.h>

typedef struct result {
    icc_map *map;
    icc_nearest_report report;
    size_t n_vertices, n_triangles;
    double *points, *images;
    uint32_t *triangles;
} result;

static icc_status make(icc_map **map, const warp *w, icc_nearest_report *report, const icc_env *env,
                       icc_error *err)
{
    const icc_mesh mesh = flat_mesh(2, w->n_vertices, w->points, w->n_triangles, w->triangles);
    const icc_nearest_options options = {sizeof options, w->n_held, w->held};
    return icc_map_create_nearest(map, &mesh, w->images, &options, report, env, err);
}

static result nearest(const warp *w, const icc_env *env)
{
    result r = {.report.size = sizeof r.report};
    icc_map_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    if (make(&r.map, w, &r.report, env, &err) != ICC_OK)
        ck_abort_msg("no map: %s", err.message);
    ck_assert_int_eq(icc_map_get_info(r.map, &info), ICC_OK);
    ck_assert_int_eq(info.certified, 1);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    r.n_vertices = info.n_vertices;
    r.n_triangles = info.n_simplices;
    r.points = malloc(2 * r.n_vertices * sizeof(double));
    r.images = malloc(2 * r.n_vertices * sizeof(double));
    r.triangles = malloc(3 * r.n_triangles * sizeof(uint32_t));
    ck_assert(r.points != NULL && r.images != NULL && r.triangles != NULL);
    ck_assert_int_eq(flat_get_mesh(r.map, r.points, r.images, r.triangles), ICC_OK);
    return r;
}

static void clear(result *r)
{
    icc_map_free(r->map);
    free(r->points);
    free(r->images);
    free(r->triangles);
}

static bool is_folded(const double *at, const uint32_t *triangle)
{
    return iccp_orient2d(at + 2 * (size_t)triangle[0], at + 2 * (size_t)triangle[1],
                         at + 2 * (size_t)triangle[2]) <= 0;
}

static bool is_same_place(const double *a, const double *b, size_t v)
{
    return memcmp(a + 2 * v, b + 2 * v, 2 * sizeof *a) == 0;
}

static bool is_on_frame(const warp *w, size_t v)
{
    return !(warp_fade(w->points + 2 * v) > 0);
}

/* The vertices are there with their numbers, frame and held ones have their images, and all
 * triangles are positive. */
static void check_result(const warp *w, const result *r)
{
    ck_assert_uint_ge(r->n_vertices, w->n_vertices);
    ck_assert_int_eq(memcmp(r->points, w->points, 2 * w->n_vertices * sizeof *r->points), 0);
    for (size_t v = 0; v < w->n_vertices; ++v)
        ck_assert(!is_on_frame(w, v) || is_same_place(r->images, w->images, v));
    for (size_t k = 0; k < w->n_held; ++k)
        ck_assert(is_same_place(r->images, w->images, w->held[k]));
    for (size_t t = 0; t < r->n_triangles; ++t)
        ck_assert(!is_folded(r->points, r->triangles + 3 * t) &&
                  !is_folded(r->images, r->triangles + 3 * t));
}

static size_t count_moved(const warp *w, const result *r)
{
    size_t n = 0;
    for (size_t v = 0; v < w->n_vertices; ++v)
        n += !is_same_place(r->images, w->images, v);
    return n;
}

START_TEST(positive_maps_stay_bit_for_bit)
{
    for (int kind = 0; kind < N_WARPS - 1; ++kind)
        for (size_t hole = 0; hole < 8; hole += 4) {
            warp w = warp_of(kind, 20, hole, 0.005, (uint64_t)kind);
            result r = nearest(&w, NULL);
            check_result(&w, &r);
            ck_assert_int_eq(r.report.repair, ICC_REPAIR_NONE);
            ck_assert_uint_eq(r.n_vertices, w.n_vertices);
            ck_assert_uint_eq(r.n_triangles, w.n_triangles);
            ck_assert_uint_eq(count_moved(&w, &r), 0);
            ck_assert(!(r.report.changed > 0) && !(r.report.most_moved > 0));
            clear(&r);
            warp_free(&w);
        }
}
END_TEST

/* Moved vertices are those of the patches and of a collar, which has as many triangles as the
 * patches, or a few rings at least. */
static void check_fold(int kind, uint64_t seed)
{
    random_source random = {seed};
    const size_t n = 24 + (size_t)random_below(&random, 24),
                 hole = kind != WARP_SWAP && seed % 3 == 0 ? 4 : 0;
    warp w = warp_of(kind, n, hole, random_between(&random, 0.1, 0.4), seed);
    result r = nearest(&w, NULL);
    size_t n_folded = 0;
    check_result(&w, &r);
    for (size_t t = 0; t < w.n_triangles; ++t)
        n_folded +=
            is_folded(w.images, w.triangles + 3 * t) != is_folded(w.points, w.triangles + 3 * t);
    ck_assert_uint_gt(r.report.n_folded, 0);
    ck_assert_uint_le(n_folded, r.report.n_folded);
    ck_assert_int_ne(r.report.repair, ICC_REPAIR_NONE);
    ck_assert(r.report.changed > 0 && r.report.changed <= 1 && r.report.n_patches > 0);
    ck_assert_double_le(r.report.moved, r.report.most_moved);
    const double share = (double)count_moved(&w, &r) / (double)w.n_vertices;
    ck_assert_msg(share < 3 * r.report.changed + 0.15, "kind %d, seed %d: %g of %g moved", kind,
                  (int)seed, share, r.report.changed);
    clear(&r);
    warp_free(&w);
}

START_TEST(folds_become_one_to_one)
{
    for (int kind = 0; kind < N_WARPS; ++kind)
        for (uint64_t seed = 1; seed <= 10; ++seed)
            check_fold(kind, 100 * (uint64_t)kind + seed);
}
END_TEST

/* A single fold in a large map. Away from it nothing moves at all, and near it hardly. */
START_TEST(rest_stays)
{
    warp w = warp_lattice(60, 0);
    for (size_t v = 0; v < w.n_vertices; ++v) {
        const double x = w.points[2 * v] - 0.3, y = w.points[2 * v + 1] - 0.6;
        w.images[2 * v] += 0.1 * exp(-150 * (x * x + y * y));
    }
    for (size_t v = 0; v < w.n_vertices; ++v)
        if (is_on_frame(&w, v))
            memcpy(w.images + 2 * v, w.points + 2 * v, 2 * sizeof *w.points);
    result r = nearest(&w, NULL);
    check_result(&w, &r);
    ck_assert_int_eq(r.report.repair, ICC_REPAIR_PATCHES);
    ck_assert_uint_eq(r.report.n_patches, 1);
    for (size_t v = 0; v < w.n_vertices; ++v) {
        const double distance = hypot(w.points[2 * v] - 0.36, w.points[2 * v + 1] - 0.6);
        ck_assert(distance < 0.3 || is_same_place(r.images, w.images, v));
    }
    ck_assert_double_lt(r.report.moved, 1e-3);
    ck_assert_double_lt(r.report.most_moved, 0.03);
    clear(&r);
    warp_free(&w);
}
END_TEST

/* Also far from the origin, and in other units. */
START_TEST(coordinates_of_any_size)
{
    for (int k = 0; k < 3; ++k) {
        const double size = k == 0 ? 1e-30 : k == 1 ? 3e20 : 1000, offset = k == 2 ? 4e6 : 0;
        warp w = warp_of(WARP_FIELD, 20, 0, 0.2, 7);
        for (size_t i = 0; i < 2 * w.n_vertices; ++i) {
            w.points[i] = size * w.points[i] + offset;
            w.images[i] = size * w.images[i] - offset;
        }
        result r = nearest(&w, NULL);
        ck_assert_int_ne(r.report.repair, ICC_REPAIR_NONE);
        ck_assert_double_lt(r.report.most_moved, size);
        ck_assert_double_gt(r.report.most_moved, 0.001 * size);
        clear(&r);
        warp_free(&w);
    }
}
END_TEST

START_TEST(threads_change_no_bit)
{
    const icc_env env = {.size = sizeof env, .threads = 4};
    for (int kind = 0; kind < N_WARPS; ++kind) {
        warp w = warp_of(kind, 40, 0, 0.2, (uint64_t)kind + 1);
        result one = nearest(&w, NULL), four = nearest(&w, &env);
        ck_assert_uint_eq(one.n_vertices, four.n_vertices);
        ck_assert_uint_eq(one.n_triangles, four.n_triangles);
        ck_assert_int_eq(memcmp(one.images, four.images, 2 * one.n_vertices * sizeof *one.images),
                         0);
        ck_assert_int_eq(
            memcmp(one.triangles, four.triangles, 3 * one.n_triangles * sizeof *one.triangles), 0);
        clear(&one);
        clear(&four);
        warp_free(&w);
    }
}
END_TEST

static icc_status make_and_free(const icc_env *env, icc_error *err, void *argument)
{
    icc_map *map = NULL;
    const icc_status status = make(&map, argument, NULL, env, err);
    ck_assert((map != NULL) == (status == ICC_OK));
    icc_map_free(map);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    warp swap = warp_of(WARP_SWAP, 10, 0, 0.2, 3), field = warp_of(WARP_FIELD, 12, 2, 0.2, 3);
    faulty_sweep(make_and_free, &swap);
    faulty_sweep(make_and_free, &field);
    warp_free(&swap);
    warp_free(&field);
}
END_TEST

static void check_error(const warp *w, icc_status status, int32_t side)
{
    icc_map *map = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(make(&map, w, NULL, NULL, &err), status);
    ck_assert_ptr_null(map);
    ck_assert_msg(err.message[0] != '\0' && err.side == side, "side %d: %s", (int)err.side,
                  err.message);
}

START_TEST(wrong_warps_are_refused)
{
    warp w = warp_lattice(6, 0);
    const warp good = w;
    for (size_t v = 0; v < w.n_vertices; ++v)
        w.images[2 * v] = -w.images[2 * v];
    check_error(&w, ICC_ERR_ARGUMENT, 2);
    memcpy(w.images, w.points, 2 * w.n_vertices * sizeof *w.images);
    w.images[0] = 0.5;
    w.images[1] = 2;
    check_error(&w, ICC_ERR_BOUNDARY, 2);
    w.images[0] = NAN;
    check_error(&w, ICC_ERR_BOUNDARY, 2);
    w.images[0] = w.images[1] = 0;
    w.points[0] = HUGE_VAL;
    check_error(&w, ICC_ERR_BOUNDARY, 1);
    w.points[0] = 0.5;
    check_error(&w, ICC_ERR_BOUNDARY, 1);
    w.points[0] = 0;
    w.n_held = 1;
    w.held[0] = (uint32_t)w.n_vertices;
    check_error(&w, ICC_ERR_ARGUMENT, 0);
    w.n_held = 0;
    const uint32_t corner = w.triangles[0];
    w.triangles[0] = w.triangles[1];
    check_error(&w, ICC_ERR_BOUNDARY, 1);
    w.triangles[0] = (uint32_t)w.n_vertices;
    check_error(&w, ICC_ERR_BOUNDARY, 1);
    w.triangles[0] = corner;
    w.n_triangles = 1;
    check_error(&w, ICC_ERR_BOUNDARY, 1);
    w = good;
    check_error(&(warp){.points = w.points, .images = w.images, .triangles = w.triangles},
                ICC_ERR_ARGUMENT, 0);
    warp_free(&w);
}
END_TEST

/* Two squares apart; and a mesh in space. */
START_TEST(wrong_meshes_are_refused)
{
    double points[16] = {0, 0, 1, 0, 1, 1, 0, 1, 3, 0, 4, 0, 4, 1, 3, 1};
    uint32_t triangles[12] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7};
    const warp w = {.n_vertices = 8,
                    .n_triangles = 4,
                    .points = points,
                    .images = points,
                    .triangles = triangles};
    check_error(&w, ICC_ERR_TOPOLOGY, 1);
    icc_map *map;
    const icc_mesh mesh = flat_mesh(3, 4, points, 1, triangles);
    ck_assert_int_eq(icc_map_create_nearest(&map, &mesh, points, NULL, NULL, NULL, NULL),
                     ICC_ERR_UNSUPPORTED);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("nearest map");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, positive_maps_stay_bit_for_bit);
    tcase_add_test(tests, folds_become_one_to_one);
    tcase_add_test(tests, rest_stays);
    tcase_add_test(tests, coordinates_of_any_size);
    tcase_add_test(tests, threads_change_no_bit);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, wrong_warps_are_refused);
    tcase_add_test(tests, wrong_meshes_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
