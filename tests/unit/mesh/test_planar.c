/* Domain meshes, and finding points in them. */
#include "foliation/certificate.h"
#include "geometry/locate.h"
#include "math/predicates.h"
#include "mesh/finder.h"

#include "../../hard_shapes.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <stdlib.h>

typedef struct meshed {
    icc_domain *domain;
    iccp_planar mesh;
    iccp_env env;
    uint32_t *pieces;
} meshed;

static meshed mesh_points(size_t n, const double *xy, int32_t cells)
{
    meshed m;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_create(&m.domain, 2, n, xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_env_read(&m.env, NULL, NULL), ICC_OK);
    m.pieces = malloc(n * sizeof *m.pieces);
    iccp_planar_pieces(m.pieces, m.domain, NULL, cells);
    if (iccp_planar_create(&m.mesh, m.domain, m.pieces, cells, &m.env, &err) != ICC_OK)
        ck_abort_msg("no mesh: %s", err.message);
    return m;
}

static void meshed_clear(meshed *m)
{
    iccp_planar_free(&m->mesh);
    icc_domain_free(m->domain);
    free(m->pieces);
}

/* Edges between boundary vertices that the mesher had to leave: their middle, rounded, is not
 * inside the two triangles. */
static size_t count_chords(const iccp_planar *mesh)
{
    size_t n = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t twin = mesh->twins[c];
        const uint32_t a = mesh->triangles[iccp_after(c)];
        const uint32_t b = mesh->triangles[iccp_before(c)];
        if (twin == ICCP_NO_NEIGHBOUR || twin < c || a >= mesh->n_boundary || b >= mesh->n_boundary)
            continue;
        ++n;
        const double *p = mesh->points + 2 * (size_t)a, *q = mesh->points + 2 * (size_t)b;
        const double *x = mesh->points + 2 * (size_t)mesh->triangles[c];
        const double *y = mesh->points + 2 * (size_t)mesh->triangles[twin];
        const double middle[2] = {0.5 * p[0] + 0.5 * q[0], 0.5 * p[1] + 0.5 * q[1]};
        ck_assert(iccp_orient2d(x, p, middle) <= 0 || iccp_orient2d(q, x, middle) <= 0 ||
                  iccp_orient2d(y, q, middle) <= 0 || iccp_orient2d(p, y, middle) <= 0);
    }
    return n;
}

/* The polygon, counter-clockwise, each facet in equal pieces. */
static void check_rim(const meshed *m)
{
    const iccp_planar *mesh = &m->mesh;
    const icc_domain *d = m->domain;
    for (uint32_t k = 0; k < mesh->n_boundary; ++k) {
        const uint32_t f = mesh->facet[k], next = (k + 1) % (uint32_t)mesh->n_boundary;
        const double *a = d->vertices + 2 * (size_t)d->facets[2 * f];
        const double *b = d->vertices + 2 * (size_t)d->facets[2 * f + 1];
        const double start = iccp_planar_along(mesh, d, k, 0),
                     end = iccp_planar_along(mesh, d, k, 1);
        ck_assert_double_eq_tol((end - start) * d->orientation, 1.0 / mesh->pieces[f], 1e-15);
        for (size_t i = 0; i < 2; ++i) {
            const double p = mesh->points[2 * (size_t)k + i],
                         q = mesh->points[2 * (size_t)next + i];
            ck_assert_double_eq_tol(p, a[i] + start * (b[i] - a[i]), 4e-16);
            ck_assert_double_eq_tol(q, a[i] + end * (b[i] - a[i]), 4e-16);
        }
    }
}

/* A share of a facet -> boundary edge -> share of the facet. */
static void check_shares(const meshed *m, random_source *r)
{
    for (uint32_t f = 0; f < m->domain->n_facets; f += 1 + (uint32_t)m->domain->n_facets / 500)
        for (int k = 0; k < 6; ++k) {
            const double along = k == 0 ? 0 : k == 1 ? 1 : random_unit(r);
            double lambda;
            const uint32_t edge = iccp_planar_edge(&m->mesh, m->domain, f, along, &lambda);
            ck_assert(edge < m->mesh.n_boundary && m->mesh.facet[edge] == f);
            ck_assert(lambda >= 0 && lambda <= 1);
            ck_assert_double_eq_tol(iccp_planar_along(&m->mesh, m->domain, edge, lambda), along,
                                    1e-15);
        }
}

/* Points of triangles, rounded, lie in them or in a neighbour; points elsewhere in none. */
static void check_finder(const meshed *m, random_source *r)
{
    const iccp_planar *mesh = &m->mesh;
    iccp_finder finder;
    iccp_finder_init(&finder, mesh, mesh->points, 0, ICCP_FEW_POINTS, &m->env.memory);
    for (int i = 0; i < share_of(2000); ++i) {
        const size_t t = (size_t)random_below(r, (int)mesh->n_triangles);
        double w[3] = {random_unit(r), random_unit(r), i % 3 == 0 ? 0 : random_unit(r)};
        if (i % 5 == 0)
            w[0] = w[2] = 0;
        double p[2] = {0, 0}, q[2] = {0, 0};
        for (size_t k = 0; k < 3; ++k)
            for (size_t j = 0; j < 2; ++j)
                p[j] +=
                    w[k] / (w[0] + w[1] + w[2]) * mesh->points[2 * mesh->triangles[3 * t + k] + j];
        iccp_found found;
        const icc_status status = iccp_finder_find(&finder, p, &found);
        const double *bary = found.bary;
        if (iccp_domain_locate(m->domain, p, true, NULL, NULL) == ICC_INSIDE)
            ck_assert_int_eq(status, ICC_OK);
        if (status != ICC_OK)
            continue;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t *v = mesh->triangles + 3 * (size_t)found.triangle;
            ck_assert(bary[k] >= 0 &&
                      iccp_orient2d(mesh->points + 2 * (size_t)v[(k + 1) % 3],
                                    mesh->points + 2 * (size_t)v[(k + 2) % 3], p) >= 0);
            for (size_t j = 0; j < 2; ++j)
                q[j] += bary[k] * mesh->points[2 * (size_t)v[k] + j];
        }
        ck_assert_double_eq_tol(bary[0] + bary[1] + bary[2], 1, 1e-15);
        ck_assert_double_le(hypot(p[0] - q[0], p[1] - q[1]), 1e-15);
    }
    const double far_away[3][2] = {{5, 0}, {-5, -5}, {0, 1e50}};
    for (int k = 0; k < 3; ++k) {
        iccp_found found;
        ck_assert_int_eq(iccp_finder_find(&finder, far_away[k], &found), ICC_ERR_TRACE);
    }
    iccp_finder_free(&finder);
}

/* Returns the number of edges between boundary vertices. */
static size_t check_mesh(size_t n, const double *xy, int32_t cells)
{
    meshed m = mesh_points(n, xy, cells);
    random_source r = {n + (uint64_t)cells};
    iccp_certificate certificate = {0};
    iccp_certify_mesh(&m.mesh, m.mesh.points, &certificate);
    ck_assert(iccp_certificate_holds(&certificate));
    const size_t n_cells = (size_t)cells * (size_t)cells;
    ck_assert_uint_le(m.mesh.n_vertices, 8 * n + 3 * n_cells);
    check_rim(&m);
    check_shares(&m, &r);
    check_finder(&m, &r);
    const size_t n_chords = count_chords(&m.mesh);
    meshed_clear(&m);
    return n_chords;
}

/* The library's pieces respect n + cells^2 boundary edges, so twice that many vertices in all. */
static size_t check_shape(const shape *s)
{
    static const int32_t CELLS[] = {2, 3, 10, 50};
    const shape reversed = shape_reversed(s);
    size_t n_chords = 0;
    for (int k = 0; k < 4; ++k)
        n_chords += check_mesh(s->n, s->xy, CELLS[k]) + check_mesh(s->n, reversed.xy, CELLS[k]);
    return n_chords;
}

START_TEST(ordinary_shapes_are_meshed)
{
    const shape s = shape_number(_i);
    ck_assert_uint_eq(check_shape(&s), 0);
}
END_TEST

START_TEST(hard_shapes_are_meshed)
{
    const shape s = shape_hard(_i);
    const size_t n_chords = check_shape(&s);
    /* Only where two sides are a few rounding errors apart edges cannot be cut. */
    if (_i != 3 && _i != 6)
        ck_assert_uint_eq(n_chords, 0);
}
END_TEST

START_TEST(gaps_of_rounding_errors_are_meshed)
{
    for (int k = 20; k <= 51; ++k) {
        const shape slit = shape_slit(ldexp(1, -k)), corridor = shape_dumbbell(ldexp(1, -k));
        (void)check_mesh(slit.n, slit.xy, 10);
        (void)check_mesh(corridor.n, corridor.xy, 10);
    }
}
END_TEST

/* A rough coast: 20,000 vertices. */
START_TEST(many_vertices_are_meshed)
{
    enum { N = 20000 };
    double *xy = malloc(2 * N * sizeof *xy);
    random_source r = {3};
    for (size_t k = 0; k < N; ++k) {
        const double a = 6.28318530717958647692 * ((double)k + 0.8 * random_unit(&r)) / N;
        const double radius = 1 + 0.2 * sin(7 * a) + 0.03 * random_unit(&r);
        xy[2 * k] = radius * cos(a);
        xy[2 * k + 1] = radius * sin(a);
    }
    static const int32_t CELLS[] = {2, 50, 200};
    for (int k = 0; k < 3; ++k)
        ck_assert_uint_eq(check_mesh(N, xy, CELLS[k]), 0);
    free(xy);
}
END_TEST

START_TEST(random_shapes_are_meshed)
{
    for (uint64_t k = 0; k < (uint64_t)share_of(300); ++k) {
        const shape s = shape_wild(5 + (size_t)(k % 100), k);
        ck_assert_uint_eq(check_mesh(s.n, s.xy, 2 + (int32_t)(k % 40)), 0);
    }
}
END_TEST

/* Two domains are cut alike, each finely enough. */
START_TEST(pieces_suit_both_domains)
{
    const shape s[2] = {shape_worm(12, 0.8, 0.2), shape_spiral(12, 1)};
    icc_domain *d[2];
    uint32_t pieces[3][SHAPE_MAX];
    for (int k = 0; k < 2; ++k)
        ck_assert_int_eq(icc_domain_create(&d[k], 2, s[k].n, s[k].xy, 0, NULL, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces[0], d[0], NULL, 50);
    iccp_planar_pieces(pieces[1], d[1], NULL, 50);
    iccp_planar_pieces(pieces[2], d[0], d[1], 50);
    for (size_t f = 0; f < s[0].n; ++f)
        ck_assert_uint_eq(pieces[2][f], pieces[0][f] > pieces[1][f] ? pieces[0][f] : pieces[1][f]);
    for (int k = 0; k < 2; ++k) {
        const double step = iccp_planar_step(d[k], 50);
        for (size_t f = 0; f < s[k].n; ++f) {
            const double *p = d[k]->vertices + 2 * f, *q = d[k]->vertices + 2 * ((f + 1) % s[k].n);
            ck_assert_double_le(hypot(q[0] - p[0], q[1] - p[1]), step * pieces[k][f] * (1 + 1e-15));
        }
        icc_domain_free(d[k]);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("domain meshes");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_loop_test(tests, ordinary_shapes_are_meshed, 0, N_SHAPES);
    tcase_add_loop_test(tests, hard_shapes_are_meshed, 0, N_HARD_SHAPES);
    tcase_add_test(tests, gaps_of_rounding_errors_are_meshed);
    tcase_add_test(tests, many_vertices_are_meshed);
    tcase_add_test(tests, random_shapes_are_meshed);
    tcase_add_test(tests, pieces_suit_both_domains);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
