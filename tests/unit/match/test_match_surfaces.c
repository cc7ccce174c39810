/* Two surfaces with different triangles become two with the same, on the shapes that were given. */
#include <icc/icc.h>

#include "../../faulty.h"
#include "../../suite.h"
#include "../../surface_domains.h"
#include "../../surfaces.h"
#include "match/common_mesh/intersections.h"
#include "match/common_mesh/simplify_apart.h"

#include <check.h>
#include <stdbool.h>

static surface one, two;

static icc_status match_both(icc_match **match, double tolerance, const icc_env *env,
                             icc_error *err)
{
    icc_domain *source = domain_of_surface(&one), *target = domain_of_surface(&two);
    const icc_match_options options = {.size = sizeof options, .tolerance = tolerance};
    const icc_status status = icc_match_create(match, source, target, 0, NULL, &options, env, err);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

static icc_match *matched(double tolerance, icc_match_info *info)
{
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(match_both(&match, tolerance, NULL, &err) == ICC_OK, "%s", err.message);
    *info = (icc_match_info){.size = sizeof *info};
    ck_assert_int_eq(icc_match_get_info(match, info), ICC_OK);
    return match;
}

/* Same triangles; vertices with an origin have its bits; the volume is what it was, nearly. */
static void check_common(const icc_match *match, const icc_match_info *info)
{
    const icc_domain *const domain[2] = {icc_match_source(match), icc_match_target(match)};
    const surface *const given[2] = {&one, &two};
    icc_domain_info size[2] = {{.size = sizeof *size}, {.size = sizeof *size}};
    uint32_t *facets[2], *origin[2];
    for (int s = 0; s < 2; ++s) {
        ck_assert_int_eq(icc_domain_get_info(domain[s], &size[s]), ICC_OK);
        ck_assert_uint_eq(size[s].n_vertices, info->n_vertices);
        ck_assert_int_eq(size[s].orientation, 1);
        facets[s] = malloc(3 * size[s].n_facets * sizeof(uint32_t));
        origin[s] = malloc(info->n_vertices * sizeof(uint32_t));
        ck_assert(facets[s] != NULL && origin[s] != NULL);
    }
    ck_assert_int_eq(icc_match_get_origins(match, origin[0], origin[1]), ICC_OK);
    size_t n_joined = 0;
    for (int s = 0; s < 2; ++s) {
        double *const x = malloc(3 * info->n_vertices * sizeof *x);
        ck_assert_ptr_nonnull(x);
        ck_assert_int_eq(icc_domain_get_boundary(domain[s], x, facets[s]), ICC_OK);
        for (size_t v = 0; v < info->n_vertices; ++v) {
            if (origin[s][v] == UINT32_MAX)
                continue;
            ck_assert_uint_lt(origin[s][v], given[s]->n_vertices);
            ck_assert_mem_eq(x + 3 * v, given[s]->vertices + 3 * (size_t)origin[s][v],
                             3 * sizeof *x);
            n_joined += s == 0 && origin[1][v] != UINT32_MAX;
        }
        free(x);
        icc_domain *const before = domain_of_surface(given[s]);
        icc_domain_info was = {.size = sizeof was};
        ck_assert_int_eq(icc_domain_get_info(before, &was), ICC_OK);
        ck_assert_double_eq_tol(size[s].measure / was.measure, 1, info->off > 0 ? .02 : 1e-12);
        icc_domain_free(before);
    }
    ck_assert_uint_eq(size[0].n_facets, size[1].n_facets);
    ck_assert_mem_eq(facets[0], facets[1], 3 * size[0].n_facets * sizeof(uint32_t));
    ck_assert_uint_eq(n_joined, info->n_joined);
    for (int s = 0; s < 2; ++s) {
        free(facets[s]);
        free(origin[s]);
    }
}

static void certify_map(const icc_match *match)
{
    icc_map *map = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_map_create(&map, icc_match_source(match), icc_match_target(match), NULL, NULL,
                                 &err) == ICC_OK,
                  "%s", err.message);
    icc_map_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_map_get_info(map, &info), ICC_OK);
    ck_assert_int_eq(info.certified, 1);
    icc_map_free(map);
}

/* An ellipsoid from a triangulation that is turned first, so that two of these have other vertices. */
static void ellipsoid(surface *s, int splits, const double axis[3], double turn)
{
    surface_octahedron(s);
    for (int i = 0; i < splits; ++i)
        surface_split(s);
    for (size_t v = 0; v < s->n_vertices; ++v) {
        double *const p = s->vertices + 3 * v, r = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
        const double x = (cos(turn) * p[0] - sin(turn) * p[1]) / r;
        const double y = (sin(turn) * p[0] + cos(turn) * p[1]) / r, z = p[2] / r;
        p[0] = axis[0] * x;
        p[1] = axis[1] * (cos(turn) * y - sin(turn) * z);
        p[2] = axis[2] * (sin(turn) * y + cos(turn) * z);
    }
}

START_TEST(ellipsoids_of_other_triangles)
{
    static const double axes[3] = {1, .7, .5}, others[3] = {2.1, 1.5, 1.2};
    ellipsoid(&one, 3, axes, 0);
    ellipsoid(&two, 3, others, .4);
    icc_match_info exact, info;
    icc_match *match = matched(-1, &exact);
    ck_assert_uint_eq(exact.n_vertices, exact.n_overlay);
    ck_assert_double_eq(exact.off, 0);
    check_common(match, &exact);
    icc_match_free(match);
    match = matched(0, &info);
    ck_assert_uint_eq(info.n_overlay, exact.n_overlay);
    ck_assert_uint_lt(3 * info.n_vertices, 2 * info.n_overlay);
    ck_assert(info.off > 0 && info.off <= 1e-3);
    ck_assert_double_lt(info.energy, 4.2);
    check_common(match, &info);
    certify_map(match);
    icc_match_free(match);
}
END_TEST

/* Turned, moved, made larger, and its vertices and faces in another order. */
static void change(surface *s, random_source *r)
{
    const surface before = *s;
    uint32_t number[SURFACE_VERTICES];
    for (uint32_t v = 0; v < s->n_vertices; ++v)
        number[v] = v;
    for (size_t v = s->n_vertices; v-- > 1;) {
        const size_t w = (size_t)random_below(r, (int)v + 1);
        const uint32_t n = number[v];
        number[v] = number[w];
        number[w] = n;
    }
    for (size_t v = 0; v < s->n_vertices; ++v) {
        const double *const p = before.vertices + 3 * v;
        double *const q = s->vertices + 3 * (size_t)number[v];
        q[0] = 3 * (cos(.9) * p[0] - sin(.9) * p[1]) + 5;
        q[1] = 3 * (cos(2.) * (sin(.9) * p[0] + cos(.9) * p[1]) - sin(2.) * p[2]);
        q[2] = 3 * (sin(2.) * (sin(.9) * p[0] + cos(.9) * p[1]) + cos(2.) * p[2]);
    }
    for (size_t c = 0; c < 3 * s->n_faces; ++c) {
        const size_t from = c / 3 * 3 + (c + 1) % 3;
        s->faces[c] = number[before.faces[(from + 3 * s->n_faces / 2 * 3) % (3 * s->n_faces)]];
    }
}

/* Their vertices become common ones, and no energy is left. */
START_TEST(equal_surfaces)
{
    static const double axes[3] = {1, .7, .5};
    random_source r = {5};
    icc_match_info info;
    for (int trial = 0; trial < 10; ++trial) {
        if (trial < 2)
            ellipsoid(&one, 3, axes, 0);
        else
            surface_star(&one, 2 + trial % 2, .7, &r);
        two = one;
        if (trial % 2 > 0 || trial > 5)
            change(&two, &r);
        icc_match *match = matched(trial < 2 ? 0 : 1e-3, &info);
        ck_assert_uint_eq(info.n_overlay, one.n_vertices);
        ck_assert_double_lt(info.energy, 4 + 1e-9);
        check_common(match, &info);
        icc_match_free(match);
    }
}
END_TEST

/* All but the triangles round a few edges are the same: these go to where they are, nearly. */
START_TEST(surfaces_that_are_nearly_equal)
{
    static const double axes[3] = {1, .7, .5};
    const iccp_env env = {.memory = iccp_memory_default};
    iccp_half_edges m;
    icc_match_info info;
    ellipsoid(&one, 2, axes, 0);
    two = one;
    ck_assert_int_eq(iccp_half_edges_create(&m, two.n_vertices, two.n_faces, two.faces, &env, NULL),
                     ICC_OK);
    iccp_edge_flip(&m, 7);
    memcpy(two.faces, m.origin, 3 * two.n_faces * sizeof *two.faces);
    iccp_half_edges_free(&m);
    icc_match *const match = matched(0, &info);
    ck_assert_double_lt(info.energy, 4.05);
    check_common(match, &info);
    icc_match_free(match);
}
END_TEST

/* Two octahedra whose edges are halved; on each, one of the new vertices is where a corner is. */
START_TEST(what_rounding_brings_together_goes)
{
    const iccp_env env = {.memory = iccp_memory_default};
    iccp_half_edges given;
    bool any = false;
    double off;
    surface_octahedron(&one);
    ck_assert_int_eq(
        iccp_half_edges_create(&given, one.n_vertices, one.n_faces, one.faces, &env, NULL), ICC_OK);
    two = one;
    surface_split(&two);
    memcpy(two.vertices + 3 * one.n_vertices, two.vertices + 3 * (size_t)two.faces[0],
           3 * sizeof(double)); /* the middle of the first face's first side */
    iccp_common_surface c = {.n_vertices = two.n_vertices, .n_faces = two.n_faces};
    c.faces = iccp_alloc(&env.memory, 3 * c.n_faces, sizeof *c.faces);
    memcpy(c.faces, two.faces, 3 * c.n_faces * sizeof *c.faces);
    for (int side = 0; side < 2; ++side) {
        c.x[side] = iccp_alloc(&env.memory, 3 * c.n_vertices, sizeof *c.x[side]);
        c.origin[side] = iccp_alloc(&env.memory, c.n_vertices, sizeof *c.origin[side]);
        c.within[side] = iccp_alloc(&env.memory, c.n_faces, sizeof *c.within[side]);
        memcpy(c.x[side], two.vertices, 3 * c.n_vertices * sizeof *c.x[side]);
        for (uint32_t v = 0; v < c.n_vertices; ++v)
            c.origin[side][v] = v < one.n_vertices ? v : ICCP_NO_EDGE;
        for (uint32_t f = 0; f < c.n_faces; ++f)
            c.within[side][f] = f / 4;
    }
    uint8_t is_bad[SURFACE_VERTICES] = {0};
    ck_assert(iccp_intersections_mark(is_bad, &any, &c, &env.memory));
    ck_assert(any);
    const iccp_simplify_limits limits = {.off = {1e-3, 1e-3}, .edge = {2, 2}};
    ck_assert_int_eq(iccp_simplify_apart(&c, &off, (const iccp_half_edges *const[]){&given, &given},
                                         (const double *const[]){one.vertices, one.vertices},
                                         &limits, true, &env),
                     ICC_OK);
    any = false;
    ck_assert(iccp_intersections_mark(is_bad, &any, &c, &env.memory));
    ck_assert(!any);
    ck_assert_uint_lt(c.n_vertices, two.n_vertices);
    ck_assert_double_le(off, 1e-9);
    iccp_common_surface_free(&c, &env.memory);
    iccp_half_edges_free(&given);
}
END_TEST

START_TEST(tolerance_is_kept)
{
    random_source r = {7};
    surface_star(&one, 3, .3, &r);
    surface_star(&two, 3, .3, &r);
    size_t before = 0;
    for (int k = 0; k < 4; ++k) {
        static const double tolerance[] = {.03, 3e-3, 1e-6, -1};
        icc_match_info info;
        icc_match *const match = matched(tolerance[k], &info);
        ck_assert_double_le(info.off, tolerance[k] > 0 ? tolerance[k] : 0);
        ck_assert_uint_ge(info.n_vertices, before);
        check_common(match, &info);
        before = info.n_vertices;
        icc_match_free(match);
    }
}
END_TEST

/* Edges of one that pass close to vertices of the other leave neither thin triangles nor many. */
START_TEST(creases_that_cross_leave_no_thin_triangles)
{
    for (int splits = 0; splits < 3; ++splits) {
        icc_match_info info;
        surface_octahedron(&one);
        for (int i = 0; i < splits; ++i)
            surface_split(&one);
        surface_octahedron(&two);
        surface_split(&two);
        surface_split(&two);
        for (size_t v = 0; v < two.n_vertices; ++v) {
            double *const p = two.vertices + 3 * v, x = p[0], y = p[1];
            p[0] = 1.2 * (cos(.3) * x - sin(.3) * y);
            p[1] = sin(.3) * x + cos(.3) * y;
            p[2] *= .9;
        }
        icc_match *const match = matched(0, &info);
        ck_assert_double_gt(info.least_angle, 1.5);
        ck_assert_uint_lt(3 * info.n_vertices, 2 * (one.n_vertices + two.n_vertices));
        ck_assert(info.off > 0 && info.off <= 1e-3);
        check_common(match, &info);
        icc_match_free(match);
    }
}
END_TEST

START_TEST(what_cannot_be_matched_is_refused)
{
    static const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    surface_octahedron(&one);
    icc_domain *const solid = domain_of_surface(&one);
    icc_domain *flat = NULL;
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create(&flat, 2, 4, square, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_match_create(&match, solid, flat, 0, NULL, NULL, NULL, &err),
                     ICC_ERR_UNSUPPORTED);
    for (int k = 0; k < 2; ++k) { /* one that is too far, two at one vertex */
        double pairs[24] = {1, 0, 0, 1, 0, 0, -1, 0, 0, -1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0};
        pairs[23] = k == 0 ? 1.5 : 1;
        pairs[12] = k == 0 ? 0 : -1;
        pairs[13] = k == 0 ? 1 : 0;
        ck_assert_int_eq(icc_match_create(&match, solid, solid, 4, pairs, NULL, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.item, ICC_ITEM_POINT);
        ck_assert_int_eq(err.index, k == 0 ? 3 : 2);
        ck_assert_int_eq(err.side, k == 0 ? 2 : 1);
    }
    for (int k = 0; k < 2; ++k) {
        const icc_match_options options = {.size = sizeof options, .tolerance = k ? NAN : .2};
        ck_assert_int_eq(icc_match_create(&match, solid, solid, 0, NULL, &options, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_ptr_nonnull(strstr(err.message, "tolerance"));
    }
    ck_assert_ptr_null(match);
    icc_domain_free(solid);
    icc_domain_free(flat);
}
END_TEST

/* All vertices are landmarks, of which many have partners that are anywhere. */
START_TEST(landmarks_without_room_are_named)
{
    random_source r = {4};
    double pairs[6 * 18];
    icc_match *match = NULL;
    icc_error err = {.size = sizeof err};
    surface_star(&one, 1, .2, &r);
    icc_domain *const solid = domain_of_surface(&one);
    ck_assert_uint_eq(one.n_vertices, 18);
    for (size_t v = 0; v < 18; ++v) {
        memcpy(pairs + 6 * v, one.vertices + 3 * v, 3 * sizeof *pairs);
        memcpy(pairs + 6 * v + 3, one.vertices + 3 * (5 * v % 18), 3 * sizeof *pairs);
    }
    ck_assert_int_eq(icc_match_create(&match, solid, solid, 18, pairs, NULL, NULL, &err),
                     ICC_ERR_RESOLUTION);
    ck_assert_int_eq(err.item, ICC_ITEM_POINT);
    ck_assert(err.index >= 0 && err.index < 18);
    ck_assert(err.side == 1 || err.side == 2);
    ck_assert_ptr_nonnull(strstr(err.message, "paths"));
    icc_domain_free(solid);
}
END_TEST

/* Any landmarks, however unrelated, go to their partners, and all is one-to-one. */
START_TEST(landmarks_go_to_their_partners)
{
    static const double axes[3] = {1, .7, .5}, others[3] = {1, .9, .6};
    random_source r = {11};
    icc_error err = {.size = sizeof err};
    for (int trial = 0; trial < share_of(12); ++trial) {
        enum { MOST = 12 };
        const size_t n = trial == 0 ? MOST : 4 + (size_t)random_below(&r, MOST - 3);
        uint32_t at[2][MOST];
        double landmarks[6 * MOST];
        ellipsoid(&one, 2, axes, 0);
        ellipsoid(&two, 2, others, .4);
        const surface *const given[2] = {&one, &two};
        for (size_t k = 0; k < n; ++k)
            for (int s = 0; s < 2; ++s) {
                bool is_new = false;
                while (!is_new) {
                    at[s][k] = (uint32_t)random_below(&r, (int)given[s]->n_vertices);
                    is_new = true;
                    for (size_t i = 0; i < k; ++i)
                        is_new = is_new && at[s][i] != at[s][k];
                }
                memcpy(landmarks + 6 * k + 3 * s, given[s]->vertices + 3 * (size_t)at[s][k],
                       3 * sizeof *landmarks);
            }
        icc_domain *source = domain_of_surface(&one), *target = domain_of_surface(&two);
        icc_match *match = NULL;
        ck_assert_msg(icc_match_create(&match, source, target, n, landmarks, NULL, NULL, &err) ==
                          ICC_OK,
                      "%d: %s", trial, err.message);
        icc_match_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
        ck_assert_uint_eq(info.n_landmarks, n);
        check_common(match, &info);
        uint32_t *const origin[2] = {malloc(info.n_vertices * sizeof(uint32_t)),
                                     malloc(info.n_vertices * sizeof(uint32_t))};
        ck_assert(origin[0] != NULL && origin[1] != NULL);
        ck_assert_int_eq(icc_match_get_origins(match, origin[0], origin[1]), ICC_OK);
        size_t n_found = 0;
        for (size_t v = 0; v < info.n_vertices; ++v)
            for (size_t k = 0; k < n; ++k)
                n_found += origin[0][v] == at[0][k] && origin[1][v] == at[1][k];
        ck_assert_uint_eq(n_found, n);
        free(origin[0]);
        free(origin[1]);
        icc_match_free(match);
        icc_domain_free(source);
        icc_domain_free(target);
    }
}
END_TEST

/* The landmarks hold all vertices, so no drawing can be moved. */
START_TEST(every_vertex_may_be_a_landmark)
{
    static const uint32_t faces[12] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    static const double first[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const double second[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, .1, .2, 1.7};
    double landmarks[24];
    for (size_t k = 0; k < 4; ++k) {
        memcpy(landmarks + 6 * k, first + 3 * k, 3 * sizeof *first);
        memcpy(landmarks + 6 * k + 3, second + 3 * k, 3 * sizeof *second);
    }
    icc_domain *source = NULL, *target = NULL;
    icc_match *match = NULL;
    icc_match_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_create(&source, 3, 4, first, 4, faces, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_domain_create(&target, 3, 4, second, 4, faces, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_match_create(&match, source, target, 4, landmarks, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_match_get_info(match, &info), ICC_OK);
    ck_assert_uint_eq(info.n_landmarks, 4);
    ck_assert_uint_ge(info.n_joined, 4);
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* Both surfaces are drawn side by side, and the bits do not tell. */
START_TEST(threads_change_nothing)
{
    static const double axes[3] = {1, .7, .5}, others[3] = {2.1, 1.5, 1.2};
    static uint8_t bytes[2][1 << 18];
    size_t n[2];
    ellipsoid(&one, 2, axes, 0);
    ellipsoid(&two, 2, others, .4);
    for (int k = 0; k < 2; ++k) {
        const icc_env env = {.size = sizeof env, .threads = 1 + 2 * k};
        icc_match *match;
        ck_assert_int_eq(match_both(&match, 0, &env, NULL), ICC_OK);
        ck_assert_int_eq(icc_match_save(match, sizeof bytes[k], bytes[k], &n[k]), ICC_OK);
        icc_match_free(match);
    }
    ck_assert_uint_eq(n[0], n[1]);
    ck_assert_mem_eq(bytes[0], bytes[1], n[0]);
}
END_TEST

static icc_status match_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_match *match = NULL;
    (void)argument;
    const icc_status status = match_both(&match, 0, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    return status;
}

static icc_status match_landmarks_once(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *source = domain_of_surface(&one), *target = domain_of_surface(&two);
    icc_match *match = NULL;
    double landmarks[6 * 5];
    for (size_t k = 0; k < 5; ++k) {
        memcpy(landmarks + 6 * k, one.vertices + 3 * k, 3 * sizeof *landmarks);
        memcpy(landmarks + 6 * k + 3, two.vertices + 3 * k, 3 * sizeof *landmarks);
    }
    const icc_status status = icc_match_create(&match, source, target, *(const size_t *)argument,
                                               landmarks, NULL, env, err);
    ck_assert((status == ICC_OK) == (match != NULL));
    icc_match_free(match);
    icc_domain_free(source);
    icc_domain_free(target);
    return status;
}

START_TEST(fails_cleanly)
{
    static const double axes[3] = {1, .7, .5}, others[3] = {1, .8, .5};
    ellipsoid(&one, 1, axes, 0);
    ellipsoid(&two, 0, axes, .4);
    faulty_sweep(match_once, NULL);
    faulty_sweep(match_landmarks_once, &(size_t){2}); /* and two guessed pairs */
    two = one;
    faulty_sweep(match_once, NULL); /* equal */
    ellipsoid(&two, 1, others, 0);
    faulty_sweep(match_landmarks_once, &(size_t){4}); /* and eight likely ones: three beginnings */
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("match_surfaces");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, ellipsoids_of_other_triangles);
    tcase_add_test(tests, equal_surfaces);
    tcase_add_test(tests, surfaces_that_are_nearly_equal);
    tcase_add_test(tests, what_rounding_brings_together_goes);
    tcase_add_test(tests, tolerance_is_kept);
    tcase_add_test(tests, creases_that_cross_leave_no_thin_triangles);
    tcase_add_test(tests, landmarks_go_to_their_partners);
    tcase_add_test(tests, every_vertex_may_be_a_landmark);
    tcase_add_test(tests, what_cannot_be_matched_is_refused);
    tcase_add_test(tests, landmarks_without_room_are_named);
    tcase_add_test(tests, threads_change_nothing);
    tcase_add_test(tests, fails_cleanly);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
