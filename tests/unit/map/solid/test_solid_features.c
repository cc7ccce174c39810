/* Maps of solids with voids, inner surfaces, lines, points and handles: certified, with everything
 * where the target has it, also after levels, on a new target, and from bytes. */
#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../infos.h"
#include "../../../reports.h"
#include "../../../saved.h"
#include "../../../suite.h"
#include "../../../surfaces.h"
#include "map/kind/kind.h"
#include "map/solid/solid_map.h"

enum { OUTER = 66, N_FEATURES = 4 };

/* A ball with a void, a region, a line and a point, moved by so much. */
typedef struct body {
    surface outer;
    double features[3 * 16];
} body;

static void move(double *x, double by)
{
    const double y[3] = {x[0] * (1 + 0.3 * by) + 0.1 * by * sin(2 * x[1]),
                         x[1] * (1 - 0.2 * by) + 0.1 * by * sin(2 * x[2]),
                         x[2] + 0.1 * by * sin(2 * x[0])};
    memcpy(x, y, sizeof y);
}

static icc_domain *body_of(double by)
{
    static body b;
    static const double LINE[9] = {-0.2, -0.4, 0.1, 0, -0.45, 0, 0.2, -0.4, -0.1};
    static const double POINT[3] = {0, 0.4, 0};
    static surface small;
    surface_octahedron(&b.outer);
    surface_split(&b.outer);
    surface_split(&b.outer);
    surface_octahedron(&small);
    for (size_t i = 0; i < 36; ++i)
        b.features[i] = 0.2 * small.vertices[i % 18] + (i % 3 == 0) * (i < 18 ? -0.4 : 0.4);
    memcpy(b.features + 36, LINE, sizeof LINE);
    memcpy(b.features + 45, POINT, sizeof POINT);
    ck_assert_uint_eq(b.outer.n_vertices, OUTER);
    for (size_t v = 0; v < OUTER; ++v) {
        double *x = b.outer.vertices + 3 * v;
        const double length = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
        for (int k = 0; k < 3; ++k)
            x[k] /= length;
        move(x, by);
    }
    for (size_t v = 0; v < 16; ++v)
        move(b.features + 3 * v, by);
    const icc_feature features[N_FEATURES] = {{.size = sizeof *features,
                                               .kind = ICC_FEATURE_HOLE,
                                               .n_vertices = 6,
                                               .vertices = b.features,
                                               .n_facets = 8,
                                               .facets = small.faces},
                                              {.size = sizeof *features,
                                               .kind = ICC_FEATURE_REGION,
                                               .n_vertices = 6,
                                               .vertices = b.features + 18,
                                               .n_facets = 8,
                                               .facets = small.faces},
                                              {.size = sizeof *features,
                                               .kind = ICC_FEATURE_LINE,
                                               .n_vertices = 3,
                                               .vertices = b.features + 36},
                                              {.size = sizeof *features,
                                               .kind = ICC_FEATURE_POINT,
                                               .n_vertices = 1,
                                               .vertices = b.features + 45}};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create_solid(&domain, OUTER, b.outer.vertices, b.outer.n_faces,
                                          b.outer.faces, N_FEATURES, features, NULL,
                                          &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

/* Line and point go where they should, their vertices exactly, and the void's inside has no image.
 * The mesh has the region's facets, so the region's inside goes into the region. */
static void check_features(const icc_map *map, double by)
{
    static const double LINE[9] = {-0.2, -0.4, 0.1, 0, -0.45, 0, 0.2, -0.4, -0.1};
    const icc_map_info info = info_of_map(map);
    ck_assert_int_eq(info.kind, ICC_MAP_MESH);
    ck_assert_int_eq(info.certified, 1);
    for (int i = 0; i <= 8; ++i) {
        const double *a = LINE + 3 * (i / 5), share = 0.25 * (i - 4 * (i / 5));
        double x[3], y[3], p[3], q[3];
        icc_status status;
        memcpy(p, a, sizeof p);
        memcpy(q, a + 3, sizeof q);
        for (int k = 0; k < 3; ++k)
            x[k] = share < 1 ? p[k] + share * (q[k] - p[k]) : q[k];
        move(p, by);
        move(q, by);
        ck_assert_int_eq(icc_map_apply(map, 1, x, y, &status, NULL, NULL), ICC_OK);
        ck_assert_int_eq(status, ICC_OK);
        for (int k = 0; k < 3; ++k)
            ck_assert_double_eq_tol(y[k], p[k] + share * (q[k] - p[k]), 1e-12);
        if (i % 4 == 0)
            ck_assert_mem_eq(y, share < 1 ? p : q, sizeof y);
    }
    double x[3] = {-0.4, 0, 0}, y[3];
    icc_status status;
    ck_assert_int_eq(icc_map_apply(map, 1, x, y, &status, NULL, NULL), ICC_OK);
    ck_assert_int_eq(status, ICC_ERR_OUTSIDE);
}

START_TEST(all_features)
{
    icc_domain *source = body_of(0), *target = body_of(1), *next = body_of(1.25);
    icc_map *map, *better, *moved, *loaded;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    check_features(map, 1);
    const icc_improve_options options = {.size = sizeof options, .levels = 2};
    icc_improve_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_map_improve(&better, map, &options, &report, NULL, NULL), ICC_OK);
    check_features(better, 1);
    ck_assert_double_lt(info_of_map(better).energy, info_of_map(map).energy);
    ck_assert_uint_gt(info_of_map(better).n_simplices, info_of_map(map).n_simplices);
    bytes saved = map_bytes(better);
    ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
    check_features(loaded, 1);
    ck_assert_int_eq(icc_map_retarget(&moved, better, next, NULL, NULL, NULL), ICC_OK);
    check_features(moved, 1.25);
    free(saved.data);
    icc_map_free(map);
    icc_map_free(better);
    icc_map_free(moved);
    icc_map_free(loaded);
    icc_domain_free(source);
    icc_domain_free(target);
    icc_domain_free(next);
}
END_TEST

/* Every facet of the region is a face of the map's mesh still, and every piece of the line an
 * edge. */
START_TEST(marks_stay)
{
    icc_domain *source = body_of(0), *target = body_of(1);
    const icc_improve_options options = {.size = sizeof options, .levels = 3};
    icc_improve_report report = {.size = sizeof report};
    icc_map *map, *better;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_map_improve(&better, map, &options, &report, NULL, NULL), ICC_OK);
    const iccp_solid_map *solid = better->state;
    const uint32_t first = OUTER + 6;
    for (uint32_t f = 0; f < 8; ++f) {
        const uint32_t *facet =
            better->source_domain->facets + 3 * (better->source_domain->n_facets + (size_t)f);
        size_t n = 0;
        for (size_t s = 0; s < solid->mesh->n_simplices; ++s) {
            size_t n_common = 0;
            for (size_t k = 0; k < 12; ++k)
                n_common += solid->mesh->corners[4 * s + k / 3] == facet[k % 3];
            n += n_common == 3;
        }
        ck_assert_uint_ge(facet[0], first);
        ck_assert_uint_eq(n, 2);
    }
    ck_assert_ptr_nonnull(solid->mesh->region);
    icc_map_free(map);
    icc_map_free(better);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* Curve maps and ties are refused by name. */
/* A big ball, two balls and a point: ball k is at (x, 0, 0) with that radius, the point at (at, 0, 0). */
static icc_domain *nested(const double ball[2][2], double at)
{
    static surface outer;
    double balls[2][18];
    const double point[3] = {at, 0, 0};
    icc_feature features[3] = {
        {.size = sizeof *features, .kind = ICC_FEATURE_POINT, .n_vertices = 1, .vertices = point}};
    icc_domain *domain;
    surface_octahedron(&outer);
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < 18; ++i)
            balls[k][i] = ball[k][1] * outer.vertices[i] + (i % 3 == 0) * ball[k][0];
        features[k + 1] = (icc_feature){.size = sizeof *features,
                                        .kind = ICC_FEATURE_REGION,
                                        .n_vertices = 6,
                                        .vertices = balls[k],
                                        .n_facets = 8,
                                        .facets = outer.faces};
    }
    ck_assert_int_eq(icc_domain_create_solid(&domain, outer.n_vertices, outer.vertices,
                                             outer.n_faces, outer.faces, 3, features, NULL, NULL),
                     ICC_OK);
    return domain;
}

static void check_refused(const icc_domain *source, const icc_domain *target, int64_t feature,
                          const char *before, const char *after)
{
    icc_error err = {.size = sizeof err};
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, &err), ICC_ERR_TOPOLOGY);
    ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
    ck_assert_int_eq(err.index, feature);
    ck_assert_msg(strstr(err.message, before) != NULL && strstr(err.message, after) != NULL &&
                      strstr(err.message, "same order") != NULL,
                  "%s", err.message);
}

/* Balls beside one another, one in the other, and the other way round, with the point in a ball or
 * in none. */
START_TEST(features_stay_in_their_regions)
{
    static const double beside[2][2] = {{-0.5, 0.2}, {0.5, 0.2}},
                        within[2][2] = {{0, 0.5}, {0, 0.2}}, around[2][2] = {{0, 0.2}, {0, 0.5}};
    icc_domain *const d[] = {nested(beside, -0.5), nested(beside, 0.5), nested(beside, 0),
                             nested(within, 0.1), nested(around, 0.1)};
    icc_map *map;
    check_refused(d[0], d[1], 0, "in feature 1 (a region) in the source",
                  "in feature 2 (a region) in the target");
    check_refused(d[2], d[1], 0, "outside all regions in the source",
                  "in feature 2 (a region) in the target");
    check_refused(d[1], d[3], 2, "outside all regions in the source",
                  "in feature 1 (a region) in the target");
    check_refused(d[3], d[4], 0, "in feature 2 (a region) in the source",
                  "in feature 1 (a region) in the target");
    ck_assert_int_eq(icc_map_create(&map, d[0], d[0], NULL, NULL, NULL), ICC_OK);
    icc_map *moved = NULL;
    ck_assert_int_eq(icc_map_retarget(&moved, map, d[1], NULL, NULL, NULL), ICC_ERR_TOPOLOGY);
    icc_map_free(map);
    for (size_t k = 0; k < sizeof d / sizeof *d; ++k)
        icc_domain_free(d[k]);
}
END_TEST

START_TEST(what_needs_charts)
{
    icc_domain *source = body_of(0), *target = body_of(1);
    const icc_chart_options chart = {.size = sizeof chart, .method = ICC_METHOD_FIELD};
    const icc_map_options options[2] = {{.size = sizeof *options, .kind = ICC_MAP_CURVES},
                                        {.size = sizeof *options, .chart = &chart}};
    for (int k = 0; k < 2; ++k) {
        icc_error err = {.size = sizeof err};
        icc_map *map;
        ck_assert_int_eq(icc_map_create(&map, source, target, &options[k], NULL, &err),
                         ICC_ERR_UNSUPPORTED);
        ck_assert_ptr_nonnull(strstr(err.message, "charts"));
    }
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

typedef struct pair {
    icc_domain *source, *target;
} pair;

static icc_status make_once(const icc_env *env, icc_error *err, void *argument)
{
    const pair *p = argument;
    icc_map *map;
    const icc_status status = icc_map_create(&map, p->source, p->target, NULL, env, err);
    icc_map_free(map);
    return status;
}

START_TEST(failures)
{
    pair p = {body_of(0), body_of(1)};
    faulty_sweep(make_once, &p);
    icc_domain_free(p.source);
    icc_domain_free(p.target);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("maps of solids with features");
    TCase *tcase = tcase_create("all");
    tcase_set_timeout(tcase, 300);
    tcase_add_test(tcase, all_features);
    tcase_add_test(tcase, marks_stay);
    tcase_add_test(tcase, features_stay_in_their_regions);
    tcase_add_test(tcase, what_needs_charts);
    tcase_add_test(tcase, failures);
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
