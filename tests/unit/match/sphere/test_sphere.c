/* Drawings of closed surfaces on the sphere: surfaces shrink and grow, drawings are one-to-one, and
 * what is not is reported. */
#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../hard_bodies.h"
#include "../../../obj.h"
#include "../../../suite.h"
#include "base/env.h"
#include "icc/icc.h"
#include "match/sphere/decimate.h"
#include "match/sphere/sphere.h"
#include "match/sphere/sphere_certificate.h"
#include "match/surface/direction.h"

#include <check.h>
#include <stdlib.h>

static surface shape;

/* ---- surfaces that shrink and grow ---- */

static iccp_half_edges half_edges(size_t n_vertices, size_t n_faces, const uint32_t *faces)
{
    iccp_half_edges m;
    const iccp_env env = default_env();
    ck_assert_int_eq(iccp_half_edges_create(&m, n_vertices, n_faces, faces, &env, NULL), ICC_OK);
    return m;
}

/* The faces that are left. */
static size_t faces_left(const iccp_half_edges *m, uint32_t *faces)
{
    uint8_t *gone = calloc(m->n_faces, 1);
    size_t n = 0;
    for (size_t k = 0; k < m->n_collapsed; ++k)
        gone[m->collapsed[k] / 3] = gone[m->twin[m->collapsed[k]] / 3] = 1;
    for (size_t f = 0; f < m->n_faces; ++f)
        if (!gone[f])
            memcpy(faces + 3 * n++, m->origin + 3 * f, 3 * sizeof *faces);
    free(gone);
    return n;
}

/* Every half-edge of what is left has a twin the other way, degrees and half-edges from vertices are
 * right, no two edges join the same vertices, and it is a sphere. */
static void check_half_edges(const iccp_half_edges *m)
{
    uint32_t *faces = malloc(3 * m->n_faces * sizeof *faces);
    const size_t n = faces_left(m, faces);
    ck_assert_uint_eq(2 * m->n_left - 4, n);
    iccp_half_edges again = half_edges(m->n_vertices, n, faces);
    ck_assert_uint_eq(again.n_left, m->n_left);
    for (uint32_t v = 0; v < m->n_vertices; ++v) {
        ck_assert_uint_eq(again.degree[v], m->degree[v]);
        uint32_t h = m->out[v], n_around = 0;
        if (m->degree[v] == 0)
            continue;
        do {
            ck_assert_uint_eq(m->origin[h], v);
            ck_assert_uint_eq(m->twin[m->twin[h]], h);
            ck_assert_uint_eq(m->origin[m->twin[h]], iccp_edge_end(m, h));
            ck_assert(iccp_are_neighbours(&again, v, iccp_edge_end(m, h)));
            h = iccp_edge_turn(m, h);
        } while (h != m->out[v] && ++n_around <= m->degree[v]);
        ck_assert_uint_eq(n_around + 1, m->degree[v]);
    }
    iccp_half_edges_free(&again);
    free(faces);
}

/* Collapses random edges until n vertices are left or chance finds none that is collapsible. */
static void collapse_some(iccp_half_edges *m, size_t n, random_source *r)
{
    for (int tries = 0; m->n_left > n && tries < 10000; ++tries) {
        const uint32_t v = (uint32_t)random_below(r, (int)m->n_vertices);
        if (m->degree[v] == 0)
            continue;
        uint32_t h = m->out[v];
        for (int k = random_below(r, (int)m->degree[v]); k > 0; --k)
            h = iccp_edge_turn(m, h);
        if (iccp_edge_collapsible(m, h)) {
            iccp_edge_collapse(m, h);
            tries = 0;
        }
    }
}

START_TEST(surfaces_shrink_and_grow)
{
    random_source r = {1};
    for (int c = 0; c < share_of(60); ++c) {
        surface_star(&shape, 1 + c % 3, .5, &r);
        iccp_half_edges m = half_edges(shape.n_vertices, shape.n_faces, shape.faces);
        check_half_edges(&m);
        collapse_some(&m, 4 + (size_t)random_below(&r, 10), &r);
        ck_assert_uint_gt(m.n_collapsed, 0);
        check_half_edges(&m);
        for (int k = random_below(&r, (int)m.n_collapsed); k > 0; --k)
            ck_assert_uint_ge(m.degree[iccp_edge_restore(&m)], 3);
        check_half_edges(&m);
        while (m.n_collapsed > 0)
            iccp_edge_restore(&m);
        ck_assert_mem_eq(m.origin, shape.faces, 3 * shape.n_faces * sizeof *m.origin);
        check_half_edges(&m);
        iccp_half_edges_free(&m);
    }
}
END_TEST

START_TEST(edges_are_flipped)
{
    random_source r = {5};
    surface_star(&shape, 2, .3, &r);
    iccp_half_edges m = half_edges(shape.n_vertices, shape.n_faces, shape.faces);
    size_t n = 0;
    collapse_some(&m, 30, &r);
    for (int k = 0; k < 400; ++k) {
        const uint32_t h = (uint32_t)random_below(&r, (int)(3 * m.n_faces)), g = m.twin[h];
        const uint32_t u = m.origin[h], v = iccp_edge_end(&m, h);
        const uint32_t b = m.origin[iccp_before(h)], a = m.origin[iccp_before(g)];
        if (m.degree[u] < 4 || m.degree[v] < 4 || m.degree[b] == 0 || iccp_are_neighbours(&m, a, b))
            continue;
        iccp_edge_flip(&m, h);
        ck_assert(iccp_are_neighbours(&m, a, b) && !iccp_are_neighbours(&m, u, v));
        ++n;
    }
    ck_assert_uint_gt(n, 40);
    check_half_edges(&m);
    iccp_half_edges_free(&m);
}
END_TEST

START_TEST(an_edge_with_other_common_neighbours_stays)
{
    /* Two tetrahedra glued along 0, 1, 2, which is no face: none of its edges is collapsible. */
    static const uint32_t faces[18] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4};
    iccp_half_edges m = half_edges(5, 6, faces);
    for (uint32_t h = 0; h < 18; ++h) {
        const bool is_inner = m.origin[h] < 3 && iccp_edge_end(&m, h) < 3;
        ck_assert_int_eq(iccp_edge_collapsible(&m, h), !is_inner);
    }
    iccp_edge_collapse(&m, m.out[3]);
    check_half_edges(&m);
    for (uint32_t v = 0; v < 5; ++v) /* a tetrahedron */
        ck_assert(m.degree[v] == 0 || !iccp_edge_collapsible(&m, m.out[v]));
    iccp_half_edges_free(&m);
}
END_TEST

START_TEST(flat_parts_go_first)
{
    /* A cube of 6 x 6 x 6 squares: its corners are what is left. */
    surface_octahedron(&shape);
    static const uint32_t n = 6;
    shape.n_vertices = shape.n_faces = 0;
    for (uint32_t side = 0; side < 6; ++side)
        for (uint32_t i = 0; i < n * n; ++i) {
            uint32_t v[4];
            for (uint32_t k = 0; k < 4; ++k) {
                double x[3];
                x[side / 2] = side % 2 ? n : 0;
                x[(side / 2 + 1) % 3] = i % n + (k == 1 || k == 2);
                x[(side / 2 + 2) % 3] = i / n + (k >= 2);
                v[k] = surface_vertex(&shape, x[0], x[1], x[2]);
            }
            surface_face(&shape, v[0], v[side % 2 ? 1 : 2], v[side % 2 ? 2 : 1]);
            surface_face(&shape, v[0], v[side % 2 ? 2 : 3], v[side % 2 ? 3 : 2]);
        }
    iccp_half_edges m = half_edges(shape.n_vertices, shape.n_faces, shape.faces);
    const iccp_env env = default_env();
    ck_assert_int_eq(iccp_decimate(&m, shape.vertices, 8, &env), ICC_OK);
    for (uint32_t v = 0; v < shape.n_vertices; ++v)
        for (uint32_t k = 0; k < 3 && m.degree[v] > 0; ++k)
            ck_assert(shape.vertices[3 * v + k] == 0 || shape.vertices[3 * v + k] == n);
    check_half_edges(&m);
    iccp_half_edges_free(&m);
}
END_TEST

/* ---- certificates ---- */

/* How many faces have a direction in them or on their sides. */
static size_t count_covering(size_t n_faces, const uint32_t *faces, const double *directions,
                             const double p[3])
{
    size_t n = 0;
    for (size_t f = 0; f < n_faces; ++f) {
        const double *a = directions + 3 * (size_t)faces[3 * f];
        const double *b = directions + 3 * (size_t)faces[3 * f + 1];
        const double *c = directions + 3 * (size_t)faces[3 * f + 2];
        n += iccp_direction_sign(a, b, p) >= 0 && iccp_direction_sign(b, c, p) >= 0 &&
             iccp_direction_sign(c, a, p) >= 0;
    }
    return n;
}

/* Poles and two rings of n vertices, which go round `turns` times. */
static void make_rings(uint32_t n, uint32_t turns)
{
    shape.n_vertices = shape.n_faces = 0;
    for (uint32_t i = 0; i < 2 * n; ++i) {
        const double angle = (double)turns * 6.283185307179586 * (i % n + .5 * (i / n)) / n;
        surface_point(&shape, cos(angle), sin(angle), i < n ? -.4 : .4);
    }
    surface_point(&shape, 0, 0, -1);
    surface_point(&shape, 0, 0, 1);
    for (uint32_t i = 0; i < n; ++i) {
        const uint32_t j = (i + 1) % n;
        surface_face(&shape, 2 * n, j, i);
        surface_face(&shape, i, j, n + i);
        surface_face(&shape, n + i, j, n + j);
        surface_face(&shape, 2 * n + 1, n + i, n + j);
    }
    for (size_t i = 0; i < shape.n_vertices; ++i)
        iccp_direction(shape.vertices + 3 * i, shape.vertices + 3 * i);
}

START_TEST(a_double_cover_is_not_certified)
{
    for (unsigned turns = 1; turns <= 3; ++turns) {
        make_rings(12, turns);
        iccp_half_edges m = half_edges(shape.n_vertices, shape.n_faces, shape.faces);
        const iccp_sphere_certificate c = iccp_sphere_certify(&m, shape.vertices);
        ck_assert_uint_eq(c.n_faces, 0);
        ck_assert_uint_eq(c.n_stars, turns == 1 ? 0 : 2);
        const double p[3] = {.3, .2, .1};
        ck_assert_uint_eq(count_covering(shape.n_faces, shape.faces, shape.vertices, p), turns);
        iccp_half_edges_free(&m);
    }
}
END_TEST

START_TEST(a_face_turned_over_or_flat_is_not_certified)
{
    make_rings(8, 1);
    iccp_half_edges m = half_edges(shape.n_vertices, shape.n_faces, shape.faces);
    double *const v = shape.vertices, kept[3];
    memcpy(kept, v, sizeof kept);
    memcpy(v, v + 3, sizeof kept); /* onto its neighbour: the faces of both are flat */
    ck_assert_uint_eq(iccp_sphere_certify(&m, v).n_faces, 2);
    const double beyond[3] = {.5 * v[6] + .5 * v[9], .5 * v[7] + .5 * v[10], -.4};
    iccp_direction(v, beyond);
    ck_assert_uint_gt(iccp_sphere_certify(&m, v).n_faces, 0);
    memcpy(v, kept, sizeof kept);
    ck_assert_uint_eq(iccp_sphere_certify(&m, v).n_faces, 0);
    iccp_half_edges_free(&m);
}
END_TEST

/* ---- drawings ---- */

/* Draws a surface, certifies it, and counts how often some directions are covered. */
static void check_drawing(size_t n_vertices, const double *x, size_t n_faces, const uint32_t *faces,
                          random_source *r)
{
    double *directions = malloc(3 * n_vertices * sizeof *directions);
    icc_error err = {.size = sizeof err};
    const iccp_env env = default_env();
    ck_assert_msg(iccp_sphere_draw(directions, n_vertices, x, n_faces, faces, &env, &err) == ICC_OK,
                  "%s", err.message);
    iccp_half_edges m = half_edges(n_vertices, n_faces, faces);
    const iccp_sphere_certificate c = iccp_sphere_certify(&m, directions);
    ck_assert_uint_eq(c.n_faces + c.n_stars, 0);
    for (size_t i = 0; i < 3 * n_vertices; ++i) {
        const double whole = directions[i] * 0x1p51;
        ck_assert(whole == floor(whole) && fabs(directions[i]) <= 1);
    }
    for (int k = 0; k < 5; ++k) {
        const double p[3] = {random_between(r, -1, 1), random_between(r, -1, 1),
                             random_between(r, -1, 1)};
        ck_assert_uint_eq(count_covering(n_faces, faces, directions, p), 1);
    }
    iccp_half_edges_free(&m);
    free(directions);
}

START_TEST(hard_surfaces_are_drawn)
{
    random_source r = {2};
    int n = 0;
    for (int c = 0; c < share_of(300); ++c) {
        icc_domain *domain;
        surface_hard(&shape, &r);
        const icc_status status = icc_domain_create(&domain, 3, shape.n_vertices, shape.vertices,
                                                    shape.n_faces, shape.faces, NULL, NULL);
        icc_domain_free(domain);
        if (status != ICC_OK)
            continue;
        check_drawing(shape.n_vertices, shape.vertices, shape.n_faces, shape.faces, &r);
        ++n;
    }
    ck_assert_int_gt(n, 0);
}
END_TEST

START_TEST(round_surfaces_stay_round)
{
    random_source r = {3};
    const iccp_env env = default_env();
    for (int splits = 0; splits < 4; ++splits) {
        surface_star(&shape, splits, 0, &r);
        double *directions = malloc(3 * shape.n_vertices * sizeof *directions);
        ck_assert_int_eq(iccp_sphere_draw(directions, shape.n_vertices, shape.vertices,
                                          shape.n_faces, shape.faces, &env, NULL),
                         ICC_OK);
        for (size_t f = 0; f < shape.n_faces; ++f)
            for (int i = 0; i < 3; ++i) {
                const size_t a = shape.faces[3 * f + (size_t)i];
                const size_t b = shape.faces[3 * f + (size_t)(i + 1) % 3];
                double length[2] = {0, 0};
                for (size_t k = 0; k < 3; ++k) {
                    const double d = directions[3 * a + k] - directions[3 * b + k];
                    const double e = shape.vertices[3 * a + k] - shape.vertices[3 * b + k];
                    length[0] += d * d;
                    length[1] += e * e;
                }
                ck_assert_double_eq_tol(sqrt(length[0] / length[1]), 1, .05);
            }
        free(directions);
    }
}
END_TEST

START_TEST(vertices_without_faces_get_zeros)
{
    random_source r = {4};
    const iccp_env env = default_env();
    double directions[3 * 7];
    surface_octahedron(&shape);
    surface_point(&shape, 1, 0, 0);
    check_drawing(7, shape.vertices, shape.n_faces, shape.faces, &r);
    ck_assert_int_eq(
        iccp_sphere_draw(directions, 7, shape.vertices, shape.n_faces, shape.faces, &env, NULL),
        ICC_OK);
    for (int k = 0; k < 3; ++k)
        ck_assert(directions[18 + k] == 0);
}
END_TEST

/* What is left of a surface after collapses at random, and then by shape. */
static void check_decimation(const obj *o, random_source *r)
{
    iccp_half_edges m = half_edges(o->n_vertices, o->n_faces, o->faces);
    const iccp_env env = default_env();
    const double rough = random_unit(r), all = rough * random_unit(r);
    collapse_some(&m, 4 + (size_t)((1 - rough / 2) * (double)o->n_vertices), r);
    ck_assert_int_eq(
        iccp_decimate(&m, o->vertices, 4 + (size_t)(all * all * (double)m.n_left), &env), ICC_OK);
    uint32_t *faces = malloc(3 * m.n_faces * sizeof *faces);
    const size_t n_faces = faces_left(&m, faces);
    check_drawing(o->n_vertices, o->vertices, n_faces, faces, r);
    free(faces);
    iccp_half_edges_free(&m);
}

static const char *const names[] = {"t01_cube_bend",      "t02_cow_pose",   "t03_body_morph",
                                    "t04_body_baby",      "t05_spot_twist", "t06_spikes_sphere",
                                    "t07_sphere_to_spot", "t08_fox"};

static bool read_shared(obj *o, int k)
{
    char path[1000];
    (void)snprintf(path, sizeof path, "%s/3d/%s.%s.obj", TEST_SHARED_DATA, names[k / 2],
                   k % 2 ? "tgt" : "src");
    return obj_read(o, path);
}

START_TEST(real_surfaces_are_drawn)
{
    random_source r = {5};
    const int n = share_of(16);
    for (int k = 0; k < n; ++k) {
        obj o;
        if (read_shared(&o, 15 - k))
            check_drawing(o.n_vertices, o.vertices, o.n_faces, o.faces, &r);
        obj_free(&o);
    }
}
END_TEST

START_TEST(decimated_surfaces_are_drawn)
{
    random_source r = {6};
    const int n = share_of(1000);
    for (int k = 0; k < 16; ++k) {
        obj o;
        if (read_shared(&o, k))
            for (int c = k; c < n; c += 16)
                check_decimation(&o, &r);
        obj_free(&o);
    }
}
END_TEST

static icc_status draw_once(const icc_env *given, icc_error *err, void *argument)
{
    const surface *s = argument;
    double *directions = malloc(3 * s->n_vertices * sizeof *directions);
    iccp_env own;
    ck_assert_int_eq(iccp_env_read(&own, given, err), ICC_OK);
    const icc_status status =
        iccp_sphere_draw(directions, s->n_vertices, s->vertices, s->n_faces, s->faces, &own, err);
    free(directions);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    random_source r = {7};
    surface_star(&shape, 3, .3, &r);
    faulty_sweep(draw_once, &shape);
}
END_TEST

START_TEST(open_surfaces_are_refused)
{
    double directions[18];
    const iccp_env env = default_env();
    icc_error err = {.size = sizeof err};
    surface_octahedron(&shape);
    ck_assert_int_eq(iccp_sphere_draw(directions, 6, shape.vertices, 7, shape.faces, &env, &err),
                     ICC_ERR_BOUNDARY);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("sphere");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 3600);
    tcase_add_test(tests, surfaces_shrink_and_grow);
    tcase_add_test(tests, edges_are_flipped);
    tcase_add_test(tests, an_edge_with_other_common_neighbours_stays);
    tcase_add_test(tests, flat_parts_go_first);
    tcase_add_test(tests, a_double_cover_is_not_certified);
    tcase_add_test(tests, a_face_turned_over_or_flat_is_not_certified);
    tcase_add_test(tests, hard_surfaces_are_drawn);
    tcase_add_test(tests, round_surfaces_stay_round);
    tcase_add_test(tests, vertices_without_faces_get_zeros);
    tcase_add_test(tests, real_surfaces_are_drawn);
    tcase_add_test(tests, decimated_surfaces_are_drawn);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, open_surfaces_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
