/* Two drawings on the sphere, cut by one another: signs that are never 0 are those of one and the
 * same moved drawing; crossings are those that all pairs of edges have; faces cover the sphere. */
#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../suite.h"
#include "../../../surfaces.h"
#include "base/env.h"
#include "match/common_mesh/shared_vertices.h"
#include "match/common_mesh/sphere_overlay.h"
#include "match/sphere/sphere.h"
#include "match/surface/direction.h"
#include "match/surface/perturbed.h"

#include <check.h>
#include <gmp.h>
#include <stdlib.h>

/* ---- signs ---- */

/* The sign for vectors moved by (2^-50)^(2^(3 r + c)), r the rank of the number. */
static int moved_sign(const double *const p[3], const uint32_t number[3])
{
    mpq_t x[3][3], sum, term;
    mpq_inits(sum, term, NULL);
    for (int i = 0; i < 3; ++i) {
        const int rank =
            (number[i] > number[0]) + (number[i] > number[1]) + (number[i] > number[2]);
        for (int c = 0; c < 3; ++c) {
            mpq_init(x[i][c]);
            mpq_set_d(x[i][c], p[i][c]);
            mpq_set_ui(term, 1, 1);
            mpq_div_2exp(term, term, 50ul << (3 * rank + c));
            mpq_add(x[i][c], x[i][c], term);
        }
    }
    static const int order[6][4] = {{0, 1, 2, 1},  {1, 2, 0, 1},  {2, 0, 1, 1},
                                    {0, 2, 1, -1}, {1, 0, 2, -1}, {2, 1, 0, -1}};
    for (int k = 0; k < 6; ++k) {
        mpq_mul(term, x[0][order[k][0]], x[1][order[k][1]]);
        mpq_mul(term, term, x[2][order[k][2]]);
        if (order[k][3] < 0)
            mpq_neg(term, term);
        mpq_add(sum, sum, term);
    }
    const int sign = mpq_sgn(sum);
    for (int i = 0; i < 9; ++i)
        mpq_clear(x[i / 3][i % 3]);
    mpq_clears(sum, term, NULL);
    return sign;
}

START_TEST(signs_are_those_of_moved_directions)
{
    random_source r = {1};
    int n_flat = 0;
    for (int k = 0; k < 3000; ++k) {
        double x[3][3];
        uint32_t number[3] = {(uint32_t)random_below(&r, 9), 0, 0};
        for (int i = 0; i < 9; ++i)
            x[i / 3][i % 3] = .25 * (random_below(&r, 3) - 1);
        number[1] = number[0] + 1 + (uint32_t)random_below(&r, 5);
        number[2] = random_below(&r, 2) ? number[1] + 3 : number[0] + 20;
        const int turn = random_below(&r, 3);
        const double *const p[3] = {x[turn], x[(turn + 1) % 3], x[(turn + 2) % 3]};
        const uint32_t q[3] = {number[(turn + 1) % 3], number[turn], number[(turn + 2) % 3]};
        ck_assert_int_eq(iccp_perturbed_sign(p, q), moved_sign(p, q));
        n_flat += iccp_direction_sign(p[0], p[1], p[2]) == 0;
    }
    ck_assert_int_gt(n_flat, 1000);
}
END_TEST

/* ---- overlays ---- */

typedef struct drawn {
    iccp_half_edges m;
    double *directions;
} drawn;

/* A surface drawn by its directions from the origin, or by iccp_sphere_draw(). */
static drawn make_drawn(const surface *s, bool from_origin)
{
    const iccp_env env = default_env();
    drawn d = {.directions = malloc(3 * s->n_vertices * sizeof *d.directions)};
    ck_assert_int_eq(iccp_half_edges_create(&d.m, s->n_vertices, s->n_faces, s->faces, &env, NULL),
                     ICC_OK);
    if (!from_origin)
        ck_assert_int_eq(iccp_sphere_draw(d.directions, s->n_vertices, s->vertices, s->n_faces,
                                          s->faces, &env, NULL),
                         ICC_OK);
    for (size_t i = 0; i < s->n_vertices && from_origin; ++i)
        iccp_direction(d.directions + 3 * i, s->vertices + 3 * i);
    return d;
}

static void free_drawn(drawn *d)
{
    iccp_half_edges_free(&d->m);
    free(d->directions);
}

static void node_direction(const iccp_sphere_overlay *o, const drawn d[2], uint32_t node, double *p)
{
    const size_t n[2] = {o->n_vertices[0], o->n_vertices[0] + o->n_vertices[1]};
    if (node < n[1]) {
        const double *const q =
            node < n[0] ? d[0].directions + 3 * (size_t)node : d[1].directions + 3 * (node - n[0]);
        memcpy(p, q, 3 * sizeof *p);
        return;
    }
    double normal[2][3];
    for (int s = 0; s < 2; ++s) {
        const uint32_t h = o->crossing[node - n[1]][s];
        iccp_vec_cross(d[s].directions + 3 * (size_t)d[s].m.origin[h],
                       d[s].directions + 3 * (size_t)iccp_edge_end(&d[s].m, h), normal[s]);
    }
    iccp_vec_cross(normal[0], normal[1], p);
    const double length = iccp_vec_norm(3, p);
    for (int k = 0; k < 3; ++k)
        p[k] /= length > 0 ? length : 1;
}

/* The solid angle of a triangle: A. van Oosterom, J. Strackee, 1983. */
static double solid_angle(const double *a, const double *b, const double *c)
{
    double n[3];
    iccp_vec_cross(b, c, n);
    return 2 * atan2(iccp_vec_dot(3, a, n),
                     1 + iccp_vec_dot(3, a, b) + iccp_vec_dot(3, b, c) + iccp_vec_dot(3, c, a));
}

/* Whether two edges cross, by all four signs; numbers as the overlay has them. */
static bool edges_cross(const iccp_drawing d[2], uint32_t h, uint32_t e)
{
    const double *p[4];
    uint32_t number[4];
    for (int k = 0; k < 4; ++k) {
        const iccp_half_edges *const m = d[k / 2].m;
        const uint32_t i = k / 2 ? e : h, v = k % 2 ? iccp_edge_end(m, i) : m->origin[i];
        p[k] = d[k / 2].directions + 3 * (size_t)v;
        number[k] = d[k / 2].number[v];
        for (int j = 0; j < k; ++j)
            if (number[j] == number[k])
                return false;
    }
    static const int three[4][3] = {{0, 1, 2}, {0, 1, 3}, {2, 3, 0}, {2, 3, 1}};
    int s[4];
    for (int k = 0; k < 4; ++k) {
        const int *const t = three[k];
        s[k] = iccp_perturbed_sign((const double *[]){p[t[0]], p[t[1]], p[t[2]]},
                                   (uint32_t[]){number[t[0]], number[t[1]], number[t[2]]});
    }
    return s[0] == -s[1] && s[1] == s[2] && s[0] == s[3];
}

static size_t count_crossings(const drawn d[2], size_t *n_different)
{
    iccp_drawing g[2] = {{.m = &d[0].m, .directions = d[0].directions},
                         {.m = &d[1].m, .directions = d[1].directions}};
    size_t n = 0;
    ck_assert_int_eq(iccp_shared_vertices_find(g, n_different, &iccp_memory_default), ICC_OK);
    for (uint32_t h = 0; h < 3 * d[0].m.n_faces; ++h)
        for (uint32_t e = 0; e < 3 * d[1].m.n_faces; ++e)
            if (h < d[0].m.twin[h] && e < d[1].m.twin[e])
                n += edges_cross(g, h, e);
    for (int s = 0; s < 2; ++s) {
        free(g[s].number);
        free(g[s].partner);
    }
    return n;
}

/* Cuts two drawings by one another and checks all that an overlay promises. */
static iccp_sphere_overlay check_overlay(const drawn d[2], bool by_pairs)
{
    iccp_sphere_overlay o;
    const iccp_env env = default_env();
    icc_error err = {.size = sizeof err};
    ck_assert_msg(
        iccp_sphere_overlay_create(&o, (const iccp_half_edges *const[]){&d[0].m, &d[1].m},
                                   (const double *const[]){d[0].directions, d[1].directions},
                                   1000000, &env, &err) == ICC_OK,
        "%s", err.message);
    size_t n_different;
    if (by_pairs) {
        ck_assert_uint_eq(o.n_crossings, count_crossings(d, &n_different));
        ck_assert_uint_eq(o.n_nodes, n_different + o.n_crossings);
    }
    double whole = 0;
    for (size_t f = 0; f < o.n_faces; ++f) {
        const uint32_t *const c = o.corner + o.begin[f];
        const size_t n = o.begin[f + 1] - o.begin[f];
        double p[ICCP_OVERLAY_CORNERS][3];
        for (size_t i = 0; i < n; ++i)
            node_direction(&o, d, c[i], p[i]);
        for (size_t i = 2; i < n; ++i) {
            const double angle = solid_angle(p[0], p[i - 1], p[i]);
            ck_assert(angle > -1e-9);
            whole += angle;
        }
    }
    ck_assert_double_eq_tol(whole, 4 * 3.14159265358979324, 1e-8);
    return o;
}

static void turn_surface(surface *s, const double q[3])
{
    for (size_t i = 0; i < s->n_vertices; ++i) { /* by quaternion 1, q */
        double *const v = s->vertices + 3 * i, c[3], e[3];
        iccp_vec_cross(q, v, c);
        for (int k = 0; k < 3; ++k)
            c[k] += v[k];
        iccp_vec_cross(q, c, e);
        for (int k = 0; k < 3; ++k)
            v[k] += 2 * e[k] / (1 + iccp_vec_dot(3, q, q));
    }
}

static surface one, two;

START_TEST(random_drawings)
{
    random_source r = {2};
    for (int k = 0; k < share_of(40); ++k) {
        surface_star(&one, k % 4, .5, &r);
        surface_star(&two, (k + 1) % 3, .5, &r);
        const double q[3] = {random_unit(&r), random_unit(&r), random_unit(&r)};
        turn_surface(&two, q);
        const bool from_origin = random_below(&r, 2);
        drawn d[2] = {make_drawn(&one, from_origin), make_drawn(&two, from_origin)};
        iccp_sphere_overlay o = check_overlay(d, true);
        ck_assert_uint_gt(o.n_crossings, 0);
        iccp_sphere_overlay_free(&o, &iccp_memory_default);
        free_drawn(&d[0]);
        free_drawn(&d[1]);
    }
}
END_TEST

START_TEST(equal_drawings)
{
    random_source r = {3};
    for (int splits = 0; splits < 4; ++splits) {
        surface_star(&one, splits, .5, &r);
        drawn d[2] = {make_drawn(&one, true), make_drawn(&one, true)};
        iccp_sphere_overlay o = check_overlay(d, splits < 3);
        ck_assert_uint_eq(o.n_crossings, 0);
        ck_assert_uint_eq(o.n_nodes, one.n_vertices);
        ck_assert_uint_eq(o.n_faces, one.n_faces);
        iccp_sphere_overlay_free(&o, &iccp_memory_default);
        free_drawn(&d[0]);
        free_drawn(&d[1]);
    }
}
END_TEST

/* Vertices on edges, edges on edges, vertices on vertices whose edges differ. */
START_TEST(degenerate_drawings)
{
    static const double quarter[3] = {1, 0, 0}, eighth[3] = {.5, 0, 0};
    for (int k = 0; k < 36; ++k) {
        surface_octahedron(&one);
        surface_octahedron(&two);
        for (int i = 0; i < k % 3; ++i)
            surface_split(&one);
        for (int i = 0; i < k / 3 % 3; ++i)
            surface_split(&two);
        if (k / 9 % 2)
            turn_surface(&two, quarter);
        if (k / 18) /* shear: vertices on edges alone */
            turn_surface(&two, eighth);
        drawn d[2] = {make_drawn(&one, true), make_drawn(&two, true)};
        iccp_sphere_overlay o = check_overlay(d, true);
        iccp_sphere_overlay_free(&o, &iccp_memory_default);
        free_drawn(&d[0]);
        free_drawn(&d[1]);
    }
}
END_TEST

START_TEST(some_vertices_in_common)
{
    random_source r = {4};
    for (int k = 0; k < share_of(60); ++k) {
        surface_star(&one, 2, .2, &r);
        two = one;
        /* Vertices move less than their faces are wide; some stay. */
        for (size_t i = 0; i < two.n_vertices; ++i)
            for (size_t c = 0; c < 3 && (i + (size_t)k) % 3 != 0; ++c)
                two.vertices[3 * i + c] += random_between(&r, -.04, .04);
        drawn d[2] = {make_drawn(&one, true), make_drawn(&two, true)};
        iccp_sphere_overlay o = check_overlay(d, true);
        ck_assert_uint_lt(o.n_nodes - o.n_crossings, 2 * one.n_vertices);
        iccp_sphere_overlay_free(&o, &iccp_memory_default);
        free_drawn(&d[0]);
        free_drawn(&d[1]);
    }
}
END_TEST

START_TEST(too_many_crossings_are_refused)
{
    static const double q[3] = {.1, .2, .3};
    surface_octahedron(&one);
    two = one;
    turn_surface(&two, q);
    drawn d[2] = {make_drawn(&one, true), make_drawn(&two, true)};
    const iccp_env env = default_env();
    iccp_sphere_overlay o = check_overlay(d, true);
    const size_t n = o.n_crossings;
    iccp_sphere_overlay_free(&o, &iccp_memory_default);
    for (size_t less = 0; less < 2; ++less) {
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(
            iccp_sphere_overlay_create(&o, (const iccp_half_edges *const[]){&d[0].m, &d[1].m},
                                       (const double *const[]){d[0].directions, d[1].directions},
                                       n - less, &env, &err),
            less ? ICC_ERR_RESOLUTION : ICC_OK);
        ck_assert((err.message[0] != '\0') == (less > 0));
        iccp_sphere_overlay_free(&o, &iccp_memory_default);
    }
    free_drawn(&d[0]);
    free_drawn(&d[1]);
}
END_TEST

static icc_status overlay_once(const icc_env *given, icc_error *err, void *argument)
{
    const drawn *const d = argument;
    iccp_sphere_overlay o;
    iccp_env own;
    ck_assert_int_eq(iccp_env_read(&own, given, err), ICC_OK);
    const icc_status status = iccp_sphere_overlay_create(
        &o, (const iccp_half_edges *const[]){&d[0].m, &d[1].m},
        (const double *const[]){d[0].directions, d[1].directions}, 1000000, &own, err);
    iccp_sphere_overlay_free(&o, &own.memory);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    static const double q[3] = {.1, .2, .3};
    random_source r = {5};
    surface_star(&one, 3, .2, &r);
    two = one;
    turn_surface(&two, q);
    drawn d[2] = {make_drawn(&one, true), make_drawn(&two, true)};
    faulty_sweep(overlay_once, d);
    free_drawn(&d[0]);
    free_drawn(&d[1]);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("overlay");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, signs_are_those_of_moved_directions);
    tcase_add_test(tests, random_drawings);
    tcase_add_test(tests, equal_drawings);
    tcase_add_test(tests, degenerate_drawings);
    tcase_add_test(tests, some_vertices_in_common);
    tcase_add_test(tests, too_many_crossings_are_refused);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
