/* Checking and repairing the image of a caller's mesh. */
#include "../../faulty.h"
#include "../../flat_mesh.h"
#include "../../meshes.h"
#include "../../shapes.h"
#include "../../suite.h"

#include <check.h>
#include <icc/icc.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static icc_map *map_between(const shape *source, const shape *target, int32_t kind)
{
    const icc_map_options options = {.size = sizeof options, .kind = kind};
    icc_domain *a, *b;
    icc_map *map;
    ck_assert_int_eq(icc_domain_create(&a, 2, source->n, source->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&b, 2, target->n, target->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, a, b, &options, NULL, NULL), ICC_OK);
    icc_domain_free(a);
    icc_domain_free(b);
    return map;
}

static icc_map *square_to_dart(void)
{
    const shape square = shape_square(), dart = shape_dart();
    return map_between(&square, &dart, 0);
}

static icc_certificate certify(const icc_map *map, size_t n, const double *vertices,
                               size_t n_triangles, const uint32_t *triangles)
{
    icc_certificate c = {.size = sizeof c};
    ck_assert_int_eq(flat_certify(map, n, vertices, n_triangles, triangles, NULL, &c, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(c.certified, c.boundary_simple && c.first < 0);
    return c;
}

/* The unit square in 2 n^2 triangles; the diagonals run towards the corner that the dart pushes in,
 * or across it. */
typedef struct grid {
    size_t n_vertices, n_triangles;
    double *vertices;
    uint32_t *triangles;
} grid;

static grid grid_of(uint32_t n, bool across)
{
    grid g = {(size_t)(n + 1) * (n + 1), 2 * (size_t)n * n, NULL, NULL};
    g.vertices = malloc(2 * g.n_vertices * sizeof(double));
    g.triangles = malloc(3 * g.n_triangles * sizeof(uint32_t));
    ck_assert(g.vertices != NULL && g.triangles != NULL);
    for (uint32_t j = 0; j <= n; ++j)
        for (uint32_t i = 0; i <= n; ++i) {
            g.vertices[2 * (j * (n + 1) + i)] = (double)i / n;
            g.vertices[2 * (j * (n + 1) + i) + 1] = (double)j / n;
        }
    uint32_t *t = g.triangles;
    for (uint32_t j = 0; j < n; ++j)
        for (uint32_t i = 0; i < n; ++i, t += 6) {
            const uint32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            const uint32_t along[6] = {a, b, c, a, c, d}, other[6] = {a, b, d, b, c, d};
            memcpy(t, across ? other : along, sizeof along);
        }
    return g;
}

static void grid_clear(grid *g)
{
    free(g->vertices);
    free(g->triangles);
}

static long double cross(const double *points, const uint32_t *v)
{
    const double *a = points + 2 * v[0], *b = points + 2 * v[1], *c = points + 2 * v[2];
    return ((long double)b[0] - a[0]) * ((long double)c[1] - a[1]) -
           ((long double)b[1] - a[1]) * ((long double)c[0] - a[0]);
}

/* Counted again, where long doubles can tell the sign. */
static void check_counts(const grid *g, const double *images, const icc_certificate *c)
{
    size_t n_inverted = 0, n_doubtful = 0;
    int64_t first = -1;
    for (size_t t = 0; t < g->n_triangles; ++t) {
        const long double before = cross(g->vertices, g->triangles + 3 * t);
        const long double after = cross(images, g->triangles + 3 * t);
        n_doubtful += fabsl(after) < 1e-17L;
        n_inverted += before * after < 0;
        if (before * after < 0 && first < 0)
            first = (int64_t)t;
    }
    ck_assert_uint_eq(n_doubtful, 0);
    ck_assert_uint_eq(c->n_inverted, n_inverted);
    ck_assert_int_eq(c->first, first);
    ck_assert_uint_eq(c->n_no_image, 0);
    ck_assert_uint_eq(c->n_flat, 0);
}

START_TEST(fine_meshes_are_certified)
{
    icc_map *map = square_to_dart();
    size_t n_certified = 0, n_faulty = 0;
    for (uint32_t n = 1; n <= 24; ++n)
        for (int across = 0; across < 2; ++across) {
            grid g = grid_of(n, across);
            double *images = malloc(2 * g.n_vertices * sizeof *images);
            double *mapped = malloc(2 * g.n_vertices * sizeof *images);
            icc_certificate c = {.size = sizeof c};
            ck_assert(images != NULL && mapped != NULL);
            ck_assert_int_eq(flat_certify(map, g.n_vertices, g.vertices, g.n_triangles, g.triangles,
                                          images, &c, NULL, NULL),
                             ICC_OK);
            (void)icc_map_apply(map, g.n_vertices, g.vertices, mapped, NULL, NULL, NULL);
            ck_assert_mem_eq(images, mapped, 2 * g.n_vertices * sizeof *images);
            check_counts(&g, images, &c);
            ck_assert_int_eq(c.boundary_simple, 1);
            /* The corner's own triangle is inverted when no diagonal ends there. */
            ck_assert(!across || c.n_inverted > 0);
            n_certified += (size_t)c.certified;
            n_faulty += !c.certified;
            free(images);
            free(mapped);
            grid_clear(&g);
        }
    ck_assert(n_certified > 0 && n_faulty >= 24);
    icc_map_free(map);
}
END_TEST

/* Two triangles, one on each side of the diagonal that the dart cuts. */
START_TEST(a_triangle_across_a_reflex_corner_is_inverted)
{
    icc_map *map = square_to_dart();
    const shape s = shape_square();
    const uint32_t across[6] = {0, 1, 3, 1, 2, 3}, along[6] = {0, 1, 2, 0, 2, 3};
    icc_certificate c = certify(map, 4, s.xy, 2, across);
    ck_assert(c.n_inverted == 1 && c.n_flat == 0 && c.n_no_image == 0 && c.first == 1);
    ck_assert(c.boundary_simple == 1 && c.certified == 0);
    c = certify(map, 4, s.xy, 2, along);
    ck_assert(c.n_inverted == 0 && c.first == -1 && c.certified == 1);
    /* Each triangle may turn its own way. */
    const uint32_t mixed[6] = {2, 1, 0, 0, 2, 3}, clockwise[6] = {2, 1, 0, 3, 2, 0};
    ck_assert_int_eq(certify(map, 4, s.xy, 2, mixed).certified, 1);
    ck_assert_int_eq(certify(map, 4, s.xy, 2, clockwise).certified, 1);
    const uint32_t mixed_across[6] = {3, 1, 0, 1, 2, 3};
    c = certify(map, 4, s.xy, 2, mixed_across);
    ck_assert(c.n_inverted == 1 && c.first == 1 && c.boundary_simple == 1);
    icc_map_free(map);
}
END_TEST

START_TEST(flat_triangles_are_counted)
{
    icc_map *map = square_to_dart();
    const double xy[10] = {0, 0, 0.5, 0, 1, 0, 1, 1, 0, 1};
    const uint32_t flat[12] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 1, 1, 3};
    icc_certificate c = certify(map, 5, xy, 3, flat);
    ck_assert(c.n_flat == 1 && c.first == 0 && c.n_inverted == 0 && c.certified == 0);
    c = certify(map, 5, xy, 4, flat);
    ck_assert(c.n_flat == 2 && c.first == 0 && c.certified == 0 && c.boundary_simple == 0);
    /* Two vertices in one place: flat, and the boundary touches itself. */
    const double twice[10] = {0, 0, 1, 0, 1, 0, 1, 1, 0, 1};
    const uint32_t fan[9] = {0, 1, 2, 0, 2, 3, 0, 3, 4};
    c = certify(map, 5, twice, 3, fan);
    ck_assert(c.n_flat == 1 && c.certified == 0 && c.boundary_simple == 0);
    icc_map_free(map);
}
END_TEST

START_TEST(vertices_without_an_image_are_counted)
{
    icc_map *map = square_to_dart();
    const double xy[12] = {0.1, 0.1, 0.5, 0.1, 0.1, 0.5, 2, 2, NAN, 0, 0.5, HUGE_VAL};
    const uint32_t one[3] = {0, 1, 2}, outside[6] = {0, 1, 2, 1, 3, 2};
    icc_certificate c = certify(map, 3, xy, 1, one);
    ck_assert(c.certified == 1 && c.n_no_image == 0);
    c = certify(map, 6, xy, 2, outside);
    ck_assert(c.n_no_image == 3 && c.first == 1 && c.n_inverted == 0 && c.n_flat == 0);
    ck_assert(c.certified == 0 && c.boundary_simple == 0);
    /* Vertices of no triangle do no harm. */
    c = certify(map, 6, xy, 1, one);
    ck_assert(c.n_no_image == 3 && c.first == -1 && c.certified == 1);
    const uint32_t all_outside[3] = {3, 4, 5};
    c = certify(map, 6, xy, 1, all_outside);
    ck_assert(c.first == 0 && c.certified == 0 && c.boundary_simple == 0);
    icc_map_free(map);
}
END_TEST

START_TEST(meshes_that_are_none)
{
    const shape square = shape_square();
    icc_map *map = map_between(&square, &square, 0);
    const double xy[20] = {0, 0,  .4, 0, 0,  .4, .4, .4, .6, .6,
                           1, .6, .6, 1, .2, .3, .8, .1, .3, .8};
    static const struct {
        const char *name;
        size_t n_triangles;
        uint32_t triangles[12];
    } CASES[] = {{"an edge of three triangles", 3, {0, 1, 2, 1, 3, 2, 1, 2, 7}},
                 {"twice the same triangle beside another", 3, {0, 1, 2, 4, 5, 6, 4, 5, 6}},
                 {"twice the same triangle", 2, {0, 1, 2, 0, 1, 2}},
                 {"twice, once turned", 2, {0, 1, 2, 0, 2, 1}},
                 {"two triangles on the same side of an edge", 2, {0, 1, 2, 0, 1, 3}},
                 {"triangles that overlap", 3, {0, 1, 2, 1, 8, 2, 8, 9, 0}}};
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        const icc_certificate c = certify(map, 10, xy, CASES[k].n_triangles, CASES[k].triangles);
        if (c.boundary_simple || c.certified || c.message[0] == 0)
            ck_abort_msg("%s: certified", CASES[k].name);
    }
    /* Triangles may share no more than a corner, as parts of a network do. */
    const uint32_t corner[6] = {0, 1, 2, 1, 4, 3};
    ck_assert_int_eq(certify(map, 10, xy, 2, corner).certified, 1);
    icc_map_free(map);
}
END_TEST

/* The map of curves too; and shapes far away, large and small. */
START_TEST(every_kind_and_size)
{
    const double scales[] = {1, 1e-300, 1e290, 1};
    for (int k = 0; k < 4; ++k) {
        shape square = shape_square(), dart = shape_dart();
        square = shape_moved(&square, scales[k], k == 3 ? 1e6 : 0, 0);
        dart = shape_moved(&dart, scales[k], 0, k == 3 ? -1e6 : 0);
        icc_map *map = map_between(&square, &dart, k % 2 ? ICC_MAP_MESH : ICC_MAP_CURVES);
        const uint32_t across[6] = {0, 1, 3, 1, 2, 3}, along[6] = {0, 1, 2, 0, 2, 3};
        ck_assert_int_eq(certify(map, 4, square.xy, 2, along).certified, 1);
        ck_assert_int_eq(certify(map, 4, square.xy, 2, across).first, 1);
        icc_map_free(map);
    }
}
END_TEST

/* ---- repair ---- */

static icc_map *square_to_boomerang(void)
{
    const shape square = shape_square();
    const shape boomerang = shape_of(4, (double[]){0, 0, 1, 0, .05, .05, 0, 1});
    return map_between(&square, &boomerang, ICC_MAP_CURVES);
}

START_TEST(meshes_are_repaired)
{
    icc_map *map = square_to_boomerang();
    size_t n_repaired = 0;
    for (uint32_t n = 1; n <= 16; ++n)
        for (int across = 0; across < 2; ++across) {
            grid g = grid_of(n, across);
            double *images = malloc(2 * g.n_vertices * sizeof *images);
            double *mapped = malloc(2 * g.n_vertices * sizeof *images);
            ck_assert(images != NULL && mapped != NULL);
            icc_certificate before = {.size = sizeof before}, after = before;
            (void)flat_certify(map, g.n_vertices, g.vertices, g.n_triangles, g.triangles, mapped,
                               &before, NULL, NULL);
            ck_assert_int_eq(flat_repair(map, g.n_vertices, g.vertices, g.n_triangles, g.triangles,
                                         images, &after, NULL, NULL),
                             ICC_OK);
            check_counts(&g, images, &after);
            ck_assert_int_eq(after.certified, !across);
            n_repaired += !before.certified && after.certified;
            ck_assert(across ? after.n_inverted > 0 : after.n_inverted == 0);
            if (before.certified)
                ck_assert_mem_eq(images, mapped, 2 * g.n_vertices * sizeof *images);
            size_t n_moved = 0;
            for (size_t v = 0; v < g.n_vertices; ++v) {
                const double x = g.vertices[2 * v], y = g.vertices[2 * v + 1];
                n_moved += (x <= 0 || y <= 0 || x >= 1 || y >= 1) &&
                           memcmp(images + 2 * v, mapped + 2 * v, 2 * sizeof *images) != 0;
            }
            ck_assert_uint_eq(n_moved, 0);
            free(images);
            free(mapped);
            grid_clear(&g);
        }
    ck_assert_uint_gt(n_repaired, 0);
    icc_map_free(map);
}
END_TEST

/* A mesh that is none, has flat triangles or no image is only certified. */
START_TEST(other_meshes_are_left_alone)
{
    icc_map *map = square_to_dart();
    const double xy[14] = {0, 0, 0.5, 0, 1, 0, 1, 1, 0, 1, 2, 2, 0.9, 0.9};
    const uint32_t cases[4][9] = {{0, 1, 2, 0, 2, 4, 2, 3, 4},
                                  {0, 2, 4, 2, 3, 4, 2, 5, 3},
                                  {0, 2, 4, 2, 3, 4, 2, 3, 4},
                                  {2, 3, 4, 2, 4, 0, 2, 6, 4}};
    for (size_t k = 0; k < 4; ++k) {
        double images[14], mapped[14];
        icc_certificate c = {.size = sizeof c};
        ck_assert_int_eq(flat_repair(map, 7, xy, 3, cases[k], images, &c, NULL, NULL), ICC_OK);
        ck_assert(c.certified == 0);
        (void)icc_map_apply(map, 7, xy, mapped, NULL, NULL, NULL);
        ck_assert_mem_eq(images, mapped, 10 * sizeof *images);
    }
    icc_map_free(map);
}
END_TEST

/* The gradient method leaves much of thin arms without images. */
START_TEST(inner_vertices_without_an_image_get_one)
{
    const shape from = shape_star(7, 0.2, 0.1), to = shape_star(7, 0.3, 0.3);
    const icc_chart_options chart = {
        .size = sizeof chart, .method = ICC_METHOD_GRADIENT, .cells = 12};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    test_mesh m = mesh_polygon(from.n, from.xy, 0.05);
    icc_domain *a, *b;
    icc_map *map;
    double *images = mesh_alloc(2 * m.n_vertices, sizeof *images);
    icc_certificate before = {.size = sizeof before}, after = before;
    ck_assert_int_eq(icc_domain_create(&a, 2, from.n, from.xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&b, 2, to.n, to.xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_create(&map, a, b, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(flat_certify(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices, NULL,
                                  &before, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(flat_repair(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices, images,
                                 &after, NULL, NULL),
                     ICC_OK);
    ck_assert(before.n_no_image > 0 && before.certified == 0);
    ck_assert(after.n_no_image == 0 && after.certified == 1);
    free(images);
    icc_map_free(map);
    icc_domain_free(a);
    icc_domain_free(b);
    mesh_free(&m);
}
END_TEST

/* ---- arguments and failures ---- */

START_TEST(bad_meshes_are_refused)
{
    icc_map *map = square_to_dart();
    const shape s = shape_square();
    const uint32_t triangles[6] = {0, 1, 2, 0, 2, 4};
    double images[8];
    for (int repair = 0; repair < 2; ++repair) {
        icc_status (*const call)(const icc_map *, size_t, const double *, size_t, const uint32_t *,
                                 double *, icc_certificate *, const icc_env *, icc_error *) =
            repair ? flat_repair : flat_certify;
        icc_certificate c = {.size = sizeof c};
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(call(map, 4, s.xy, 2, triangles, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.index, 1);
        ck_assert_int_eq(call(map, 5, s.xy, 0, triangles, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(call(map, 2, s.xy, 1, triangles, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(call(map, SIZE_MAX, s.xy, 1, triangles, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(call(map, 4, s.xy, SIZE_MAX, triangles, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        const double tiny[8] = {0, 0, 1, 0, 1, 1, 1e-300, 1};
        ck_assert_int_eq(call(map, 4, tiny, 1, triangles, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.index, 3);
    }
    icc_map_free(map);
}
END_TEST

typedef struct job {
    icc_map *map;
    grid g;
    double *images;
    bool repair;
} job;

static icc_status run_job(const icc_env *env, icc_error *err, void *argument)
{
    const job *j = argument;
    icc_certificate c = {.size = sizeof c};
    const icc_status status =
        j->repair ? flat_repair(j->map, j->g.n_vertices, j->g.vertices, j->g.n_triangles,
                                j->g.triangles, j->images, &c, env, err)
                  : flat_certify(j->map, j->g.n_vertices, j->g.vertices, j->g.n_triangles,
                                 j->g.triangles, NULL, &c, env, err);
    ck_assert(status != ICC_OK || c.certified == j->repair);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    job j = {.map = square_to_boomerang(), .g = grid_of(4, false)};
    j.images = malloc(2 * j.g.n_vertices * sizeof *j.images);
    ck_assert_ptr_nonnull(j.images);
    for (int k = 0; k < 2; ++k) {
        j.repair = k;
        faulty_sweep(run_job, &j);
    }
    free(j.images);
    grid_clear(&j.g);
    icc_map_free(j.map);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("certify");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, fine_meshes_are_certified);
    tcase_add_test(tests, a_triangle_across_a_reflex_corner_is_inverted);
    tcase_add_test(tests, flat_triangles_are_counted);
    tcase_add_test(tests, vertices_without_an_image_are_counted);
    tcase_add_test(tests, meshes_that_are_none);
    tcase_add_test(tests, every_kind_and_size);
    tcase_add_test(tests, meshes_are_repaired);
    tcase_add_test(tests, other_meshes_are_left_alone);
    tcase_add_test(tests, inner_vertices_without_an_image_get_one);
    tcase_add_test(tests, bad_meshes_are_refused);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
