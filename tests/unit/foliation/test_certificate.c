/* Certificates hold for what the library makes, and refuse it once anything in it is wrong. */
#include "foliation/certificate.h"
#include "foliation/harmonic.h"

#include "../../hard_shapes.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <stdlib.h>

typedef struct subject {
    icc_domain *domain;
    iccp_env env;
    iccp_harmonic base;
    iccp_psi psi;
} subject;

static subject subject_of(const shape *s, int32_t cells)
{
    subject x;
    uint32_t pieces[SHAPE_MAX];
    ck_assert_int_eq(icc_domain_create(&x.domain, 2, s->n, s->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_env_read(&x.env, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces, x.domain, NULL, cells);
    ck_assert_int_eq(iccp_harmonic_create(&x.base, x.domain, pieces, cells, &x.env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_harmonic_factorise(&x.base, &x.env, NULL), ICC_OK);
    const uint32_t centre = iccp_deepest_vertex(&x.base.mesh, x.domain);
    ck_assert_int_eq(iccp_psi_create(&x.psi, &x.base.mesh, &x.base.laplacian, &x.base.solver,
                                     centre, 0.5, &x.env),
                     ICC_OK);
    return x;
}

static void subject_clear(subject *x)
{
    iccp_psi_free(&x->psi);
    iccp_harmonic_free(&x->base);
    icc_domain_free(x->domain);
}

static iccp_certificate certify(const subject *x)
{
    iccp_certificate c = {0};
    iccp_certify_mesh(&x->base.mesh, x->base.mesh.points, &c);
    ck_assert_int_eq(iccp_certify_psi(&x->base.mesh, &x->psi, &c, &x->env.memory), ICC_OK);
    return c;
}

static bool holds(const subject *x)
{
    const iccp_certificate c = certify(x);
    return iccp_certificate_holds(&c);
}

static uint32_t random_corner(const subject *x, random_source *r)
{
    return (uint32_t)random_below(r, 3 * (int)x->base.mesh.n_triangles);
}

/* A corner whose triangle does not touch the centre. */
static uint32_t random_outer_corner(const subject *x, random_source *r)
{
    for (;;) {
        const uint32_t c = random_corner(x, r), *v = x->base.mesh.triangles + c - c % 3;
        if (v[0] != x->psi.centre && v[1] != x->psi.centre && v[2] != x->psi.centre)
            return c;
    }
}

START_TEST(twins_must_fit)
{
    const shape s = shape_l();
    subject x = subject_of(&s, 12);
    random_source r = {1};
    ck_assert(holds(&x));
    for (int k = 0; k < share_of(500); ++k) {
        const uint32_t c = random_corner(&x, &r), old = x.base.mesh.twins[c];
        const uint32_t other = k % 7 == 0 ? ICCP_NO_NEIGHBOUR : random_corner(&x, &r);
        x.base.mesh.twins[c] = other;
        ck_assert(old == other || certify(&x).n_topology > 0);
        x.base.mesh.twins[c] = old;
    }
    ck_assert(holds(&x));
    subject_clear(&x);
}
END_TEST

START_TEST(triangles_must_fit)
{
    const shape s = shape_star(5, 0.4, 0.1);
    subject x = subject_of(&s, 12);
    random_source r = {2};
    iccp_planar *mesh = &x.base.mesh;
    for (int k = 0; k < share_of(500); ++k) {
        const uint32_t c = random_corner(&x, &r), old = mesh->triangles[c];
        mesh->triangles[c] = (uint32_t)random_below(&r, (int)mesh->n_vertices);
        ck_assert(mesh->triangles[c] == old || certify(&x).n_topology > 0);
        mesh->triangles[c] = old;
    }
    /* Two boundary vertices change places everywhere; one vertex too many. */
    for (int swap = 0; swap < 2; ++swap) {
        for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c)
            mesh->triangles[c] = mesh->triangles[c] == 3   ? 4
                                 : mesh->triangles[c] == 4 ? 3
                                                           : mesh->triangles[c];
        ck_assert(swap == 1 || certify(&x).n_topology > 0);
    }
    --mesh->n_triangles;
    ck_assert_uint_gt(certify(&x).n_topology, 0);
    ++mesh->n_triangles;
    ck_assert(holds(&x));
    subject_clear(&x);
}
END_TEST

/* A vertex moved to the middle of the edge that it faces flattens a triangle, one beyond it inverts
 * it: even by the smallest number. */
START_TEST(triangles_must_be_positive)
{
    const shape s = shape_e();
    subject x = subject_of(&s, 20);
    random_source r = {3};
    iccp_planar *mesh = &x.base.mesh;
    for (int k = 0; k < share_of(300); ++k) {
        const uint32_t c = random_corner(&x, &r);
        double *p = mesh->points + 2 * (size_t)mesh->triangles[c];
        const double old[2] = {p[0], p[1]};
        const double *a = mesh->points + 2 * (size_t)mesh->triangles[iccp_after(c)];
        const double *b = mesh->points + 2 * (size_t)mesh->triangles[iccp_before(c)];
        for (int i = 0; i < 2; ++i)
            p[i] = k % 2 ? a[i] : a[i] + b[i] - old[i];
        iccp_certificate certificate = {0};
        iccp_certify_mesh(mesh, mesh->points, &certificate);
        ck_assert_uint_gt(certificate.n_inverted, 0);
        ck_assert(!iccp_certificate_holds(&certificate));
        memcpy(p, old, sizeof old);
    }
    ck_assert(holds(&x));
    subject_clear(&x);
}
END_TEST

START_TEST(rises_must_close)
{
    const shape s = shape_dart();
    subject x = subject_of(&s, 15);
    random_source r = {4};
    for (int k = 0; k < share_of(500); ++k) {
        const uint32_t c = random_outer_corner(&x, &r), d = iccp_after(c);
        const int64_t old[2] = {x.psi.rise[c], x.psi.rise[d]};
        x.psi.rise[c] += k % 2 ? 1 : -1;
        ck_assert_uint_gt(certify(&x).n_open, 0);
        /* The triangle closes again, but its neighbours say something else. */
        x.psi.rise[d] -= k % 2 ? 1 : -1;
        ck_assert(!holds(&x));
        x.psi.rise[c] = old[0];
        x.psi.rise[d] = old[1];
    }
    ck_assert(holds(&x));
    subject_clear(&x);
}
END_TEST

/* Raises psi at one vertex: all triangles still close. */
static void shift(subject *x, uint32_t vertex, int64_t amount)
{
    const iccp_planar *mesh = &x->base.mesh;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->triangles[iccp_after(c)];
        const uint32_t b = mesh->triangles[iccp_before(c)];
        if (a != x->psi.centre && b != x->psi.centre)
            x->psi.rise[c] += b == vertex ? amount : a == vertex ? -amount : 0;
    }
}

/* The most and the least that the neighbours of a vertex lie above it. */
static void neighbours_of(const subject *x, uint32_t vertex, int64_t *least, int64_t *most)
{
    const iccp_planar *mesh = &x->base.mesh;
    *least = INT64_MAX;
    *most = INT64_MIN;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->triangles[iccp_after(c)];
        const uint32_t b = mesh->triangles[iccp_before(c)];
        if ((a != vertex && b != vertex) || a == x->psi.centre || b == x->psi.centre)
            continue;
        const int64_t rise = a == vertex ? x->psi.rise[c] : -x->psi.rise[c];
        *least = rise < *least ? rise : *least;
        *most = rise > *most ? rise : *most;
    }
}

START_TEST(vertices_must_be_regular)
{
    const shape s = shape_l();
    subject x = subject_of(&s, 12);
    const uint32_t n_boundary = (uint32_t)x.base.mesh.n_boundary;
    for (uint32_t v = 0; v < x.base.mesh.n_vertices; ++v) {
        int64_t least, most;
        if (v == x.psi.centre)
            continue;
        neighbours_of(&x, v, &least, &most);
        ck_assert(least < 0 && most > 0);
        /* One above all neighbours, one below all. */
        for (int k = 0; k < 2; ++k) {
            const int64_t amount = k ? most + 1 : least - 1;
            shift(&x, v, amount);
            const iccp_certificate c = certify(&x);
            ck_assert_uint_eq(c.n_open, 0);
            ck_assert_uint_gt(c.n_irregular, 0);
            ck_assert(v >= n_boundary || c.n_flat > 0);
            shift(&x, v, -amount);
        }
    }
    ck_assert(holds(&x));
    subject_clear(&x);
}
END_TEST

/* Equal labels are ordered by index and do no harm; a triangle with three is refused. */
START_TEST(ties_are_ordered)
{
    const shape s = shape_square();
    subject x = subject_of(&s, 12);
    const iccp_planar *mesh = &x.base.mesh;
    size_t n_tied = 0, n_flat = 0;
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = mesh->triangles[iccp_after(c)];
        const uint32_t b = mesh->triangles[iccp_before(c)], o = mesh->triangles[c];
        if (a < mesh->n_boundary || b < mesh->n_boundary || o < mesh->n_boundary ||
            a == x.psi.centre || b == x.psi.centre || o == x.psi.centre)
            continue;
        const int64_t amount = x.psi.rise[c];
        shift(&x, a, amount);
        const iccp_certificate tied = certify(&x);
        /* On the link of the centre it is an error. */
        ck_assert(tied.n_ties > 0 || tied.n_flat > 0);
        n_tied += iccp_certificate_holds(&tied);
        const int64_t second = x.psi.rise[iccp_after(c)];
        shift(&x, o, -second);
        const iccp_certificate flat = certify(&x);
        ck_assert_uint_gt(flat.n_flat, 0);
        n_flat += flat.n_flat > 0;
        shift(&x, o, second);
        shift(&x, a, -amount);
    }
    ck_assert_uint_gt(n_tied, 20);
    ck_assert_uint_gt(n_flat, 20);
    ck_assert(holds(&x));
    subject_clear(&x);
}
END_TEST

START_TEST(psi_must_wind_once_upwards)
{
    const shape s = shape_star(4, 0.5, 0);
    subject x = subject_of(&s, 10);
    const size_t n = 3 * x.base.mesh.n_triangles;
    for (size_t c = 0; c < n; ++c)
        x.psi.rise[c] = -x.psi.rise[c];
    iccp_certificate c = certify(&x);
    ck_assert(c.n_flat > 0 && c.n_irregular > 0 && c.n_open == 0);
    for (size_t k = 0; k < n; ++k)
        x.psi.rise[k] *= -2;
    c = certify(&x);
    ck_assert(c.n_irregular == 1 && c.n_flat == 0 && c.n_open == 0);
    subject_clear(&x);
}
END_TEST

static shape stress_shape(int k)
{
    if (k < 24)
        return shape_wild(8 + (size_t)k * 4, 1000 + (uint64_t)k);
    return k == 24   ? shape_spiral(40, 2.5)
           : k == 25 ? shape_comb(8)
           : k == 26 ? shape_channel(40)
                     : shape_needle();
}

/* 24 random star-shaped polygons, a spiral, a comb, a channel, a needle; two resolutions each. */
START_TEST(stress_meshes_are_certified)
{
    const shape s = stress_shape(_i % 28);
    const int32_t cells = _i < 28 ? 50 : 150;
    for (int32_t method = ICC_METHOD_FOLIATION; method <= ICC_METHOD_DISC; method += 2) {
        icc_domain *domain;
        icc_chart *chart;
        const icc_chart_options options = {
            .size = sizeof options, .method = method, .cells = cells};
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_domain_create(&domain, 2, s.n, s.xy, 0, NULL, NULL, NULL), ICC_OK);
        if (icc_chart_create(&chart, domain, &options, NULL, &err) != ICC_OK)
            ck_abort_msg("%s", err.message);
        icc_chart_info info = {.size = sizeof info};
        icc_foliation_info own = {.size = sizeof own};
        (void)icc_chart_get_info(chart, &info);
        (void)icc_chart_get_foliation_info(chart, &own);
        /* At the first attempt. */
        ck_assert(info.certified == 1 && info.cells == cells);
        ck_assert(method == ICC_METHOD_DISC || own.harmonic_share >= 0.5);
        icc_chart_free(chart);
        icc_domain_free(domain);
    }
}
END_TEST

/* What cannot be certified is refused, with a reason: edges as short as rounding errors, a triangle
 * as thin. */
START_TEST(what_cannot_be_certified_is_refused)
{
    const shape s[2] = {shape_fillet(1e-15),
                        shape_of(3, (double[]){0, 0, 1, .7, .5 - 7e-16, .35 + 1e-15})};
    for (int k = 0; k < 4; ++k) {
        icc_domain *domain;
        icc_chart *chart = (icc_chart *)&chart;
        const icc_chart_options options = {
            .size = sizeof options, .method = k % 2 ? ICC_METHOD_FOLIATION : ICC_METHOD_DISC};
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(
            icc_domain_create(&domain, 2, s[k / 2].n, s[k / 2].xy, 0, NULL, NULL, NULL), ICC_OK);
        const icc_status status = icc_chart_create(&chart, domain, &options, NULL, &err);
        /* The triangle's sides touch when they are rounded at some of the points that were
         * tried. */
        ck_assert(status == ICC_ERR_CERTIFICATE || (status == ICC_OK && k >= 2));
        ck_assert(status == ICC_OK || (chart == NULL && err.status == status && err.index == -1));
        ck_assert(status == ICC_OK || err.message[0] != '\0');
        icc_chart_free(chart);
        icc_domain_free(domain);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("certificates");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, twins_must_fit);
    tcase_add_test(tests, triangles_must_fit);
    tcase_add_test(tests, triangles_must_be_positive);
    tcase_add_test(tests, rises_must_close);
    tcase_add_test(tests, vertices_must_be_regular);
    tcase_add_test(tests, ties_are_ordered);
    tcase_add_test(tests, psi_must_wind_once_upwards);
    tcase_add_loop_test(tests, stress_meshes_are_certified, 0, 56);
    tcase_add_test(tests, what_cannot_be_certified_is_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
