/* Solids with voids, inner surfaces, lines and points: what is accepted, what is said of the others,
 * and what a mesh of them must be. */
#include "../../faulty.h"
#include "../../solid_cells.h"
#include "../../suite.h"
#include "../../surfaces.h"
#include "base/error.h"
#include "domain/domain_file.h"
#include "domain/solid_domain.h"
#include "domain/solid_mesh.h"

#include <check.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_FEATURES = 12 };

/* ---------------------------------------------------------------- solids */

typedef struct sketch {
    surface outer;
    size_t n;
    icc_feature features[MOST_FEATURES];
    surface own[MOST_FEATURES];
    double vertices[MOST_FEATURES][3 * 8]; /* of lines and points */
} sketch;

static sketch s;

static void octahedron(surface *to, double x, double y, double z, double radius)
{
    const double at[3] = {x, y, z};
    surface_octahedron(to);
    for (size_t i = 0; i < 3 * to->n_vertices; ++i)
        to->vertices[i] = radius * to->vertices[i] + at[i % 3];
}

/* An octahedron of radius 1 without features. */
static void begin(void)
{
    s.n = 0;
    octahedron(&s.outer, 0, 0, 0, 1);
}

static void turn_over(surface *own)
{
    for (size_t f = 0; f < own->n_faces; ++f) {
        const uint32_t swap = own->faces[3 * f];
        own->faces[3 * f] = own->faces[3 * f + 1];
        own->faces[3 * f + 1] = swap;
    }
}

static void add_surface(int32_t kind)
{
    const surface *own = &s.own[s.n];
    s.features[s.n++] = (icc_feature){.size = sizeof(icc_feature),
                                      .kind = kind,
                                      .n_vertices = own->n_vertices,
                                      .vertices = own->vertices,
                                      .n_facets = own->n_faces,
                                      .facets = own->faces};
}

static void add_ball(int32_t kind, double x, double y, double z, double radius)
{
    octahedron(&s.own[s.n], x, y, z, radius);
    add_surface(kind);
}

/* A line, or a point if n is 1. */
static void add_line(size_t n, const double *vertices)
{
    memcpy(s.vertices[s.n], vertices, 3 * n * sizeof *vertices);
    s.features[s.n] = (icc_feature){.size = sizeof(icc_feature),
                                    .kind = n == 1 ? ICC_FEATURE_POINT : ICC_FEATURE_LINE,
                                    .n_vertices = n,
                                    .vertices = s.vertices[s.n]};
    ++s.n;
}

static void add_point(double x, double y, double z)
{
    add_line(1, (const double[3]){x, y, z});
}

static icc_status create(icc_domain **out, const icc_env *env, icc_error *err)
{
    return icc_domain_create_solid(out, s.outer.n_vertices, s.outer.vertices, s.outer.n_faces,
                                   s.outer.faces, s.n, s.features, env, err);
}

static icc_domain *make(void)
{
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(create(&domain, NULL, &err) == ICC_OK, "%s", err.message);
    return domain;
}

static icc_domain_info info_of(const icc_domain *domain)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    return info;
}

static icc_feature_info feature_of(const icc_domain *domain, size_t feature)
{
    icc_feature_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_feature(domain, feature, &info), ICC_OK);
    return info;
}

/* Expects a message that begins with, or is, this text. */
static void refuse(icc_status status, int64_t feature, const char *text)
{
    icc_domain *domain = (icc_domain *)&domain;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(create(&domain, NULL, &err), status);
    ck_assert_ptr_null(domain);
    ck_assert_msg(strncmp(err.message, text, strlen(text)) == 0, "%s", err.message);
    ck_assert_int_eq(err.index, feature);
    ck_assert_int_eq(err.item, ICC_ITEM_FEATURE);
}

/* ---------------------------------------------------------------- accepted */

static void everything(void)
{
    begin();
    add_ball(ICC_FEATURE_REGION, -0.3, 0, 0, 0.5);
    add_ball(ICC_FEATURE_HOLE, 0.5, 0, 0, 0.125);
    add_ball(ICC_FEATURE_REGION, -0.25, 0, 0, 0.25);
    add_line(3, (const double[9]){0.5, 0.25, 0, 0.5, 0.25, 0.125, 0.375, 0.375, 0});
    add_ball(ICC_FEATURE_HOLE, -0.25, 0, 0.03125, 0.125);
    add_point(-0.4375, 0, 0);
    add_line(2, (const double[6]){-0.6, 0, 0, -0.6, 0.1, 0.1});
    turn_over(&s.own[0]);
    turn_over(&s.own[4]);
}

START_TEST(everything_is_accepted)
{
    static const int32_t orientations[7] = {-1, 1, 1, 0, -1, 0, 0};
    static const size_t around[7] = {0, 0, 1, 0, 2, 2, 1};
    everything();
    icc_domain *d = make();
    const icc_domain_info info = info_of(d);
    ck_assert_uint_eq(info.n_vertices, 5 * 6 + 3 + 1 + 2);
    ck_assert_uint_eq(info.n_facets, 5 * 8);
    ck_assert_uint_eq(info.n_features, 7);
    ck_assert_uint_eq(info.n_holes, 2);
    ck_assert_uint_eq(info.n_regions, 2);
    ck_assert_uint_eq(info.n_lines, 2);
    ck_assert_uint_eq(info.n_points, 1);
    ck_assert_uint_eq(info.n_voids, 2);
    ck_assert_uint_eq(info.genus, 0);
    ck_assert_uint_eq(info.n_pieces, 8);
    ck_assert_uint_eq(info.n_faces, 3);
    ck_assert_double_eq_tol(info.measure, 4.0 / 3 * (1 - 2.0 / 512), 1e-14);
    size_t facet = 8;
    for (int kind = ICC_FEATURE_HOLE; kind <= ICC_FEATURE_REGION; kind += 3)
        for (size_t f = 0; f < 7; ++f) {
            const icc_feature_info own = feature_of(d, f);
            ck_assert_int_eq(own.kind, s.features[f].kind);
            ck_assert_int_eq(own.orientation, orientations[f]);
            ck_assert_uint_eq(own.around, around[f]);
            ck_assert_uint_eq(own.genus, 0);
            ck_assert_uint_eq(own.n_facets, s.features[f].n_facets);
            if (own.kind == kind) {
                ck_assert_uint_eq(own.first_facet, facet);
                facet += 8;
            }
        }
    icc_domain_free(d);
}
END_TEST

START_TEST(boundary_is_as_given)
{
    double vertices[3 * 36];
    uint32_t facets[3 * 40];
    everything();
    icc_domain *d = make();
    ck_assert_int_eq(icc_domain_get_boundary(d, vertices, facets), ICC_OK);
    ck_assert_mem_eq(vertices, s.outer.vertices, 18 * sizeof *vertices);
    ck_assert_mem_eq(facets, s.outer.faces, 24 * sizeof *facets);
    for (size_t f = 0; f < s.n; ++f) {
        const icc_feature_info own = feature_of(d, f);
        ck_assert_mem_eq(vertices + 3 * own.first_vertex, s.features[f].vertices,
                         3 * own.n_vertices * sizeof *vertices);
        for (size_t i = 0; i < 3 * own.n_facets; ++i)
            ck_assert_uint_eq(facets[3 * own.first_facet + i],
                              own.first_vertex + s.features[f].facets[i]);
    }
    icc_domain_free(d);
}
END_TEST

START_TEST(points_are_located)
{
    static const struct {
        double at[3];
        int32_t where;
    } points[] = {{{0.5, 0, 0}, ICC_OUTSIDE},      {{0.375, 0, 0}, ICC_BOUNDARY},
                  {{-0.25, 0, 0}, ICC_OUTSIDE},    {{-0.5, 0, 0}, ICC_INSIDE},
                  {{-0.4375, 0, 0}, ICC_INSIDE},   {{0.5, 0.25, 0.0625}, ICC_INSIDE},
                  {{2, 0, 0}, ICC_OUTSIDE},        {{1, 0, 0}, ICC_BOUNDARY},
                  {{0.5, 0.0625, 0}, ICC_OUTSIDE}, {{0.01, -0.01, 0.3}, ICC_INSIDE}};
    everything();
    icc_domain *d = make();
    for (size_t i = 0; i < sizeof points / sizeof *points; ++i) {
        int32_t where;
        uint32_t facet;
        double bary[3];
        ck_assert_int_eq(icc_domain_locate(d, 1, points[i].at, &where, &facet, bary, NULL), ICC_OK);
        ck_assert_msg(where == points[i].where, "%zu: %d", i, (int)where);
        ck_assert_uint_lt(facet, 24); /* of the boundary */
    }
    icc_domain_free(d);
}
END_TEST

static icc_status make_all(const icc_env *env, icc_error *err, void *argument)
{
    icc_domain *domain;
    (void)argument;
    const icc_status status = create(&domain, env, err);
    icc_domain_free(domain);
    return status;
}

START_TEST(allocations_and_patience_may_end)
{
    everything();
    faulty_sweep(make_all, NULL);
}
END_TEST

START_TEST(no_features_make_a_plain_domain)
{
    begin();
    icc_domain *d = make();
    ck_assert_uint_eq(info_of(d).n_features, 0);
    icc_domain_free(d);
}
END_TEST

static void add_torus(int32_t kind, double x, double z, double radius, double thickness, int turns,
                      int loops, bool upright)
{
    enum { LONG = 36, ROUND = 6 };
    static const double pi = 3.141592653589793;
    surface *own = &s.own[s.n];
    own->n_vertices = own->n_faces = 0;
    for (int i = 0; i < LONG; ++i)
        for (int j = 0; j < ROUND; ++j) {
            const double t = 2 * pi * i / LONG, u = 2 * pi * j / ROUND;
            const double ring = radius * (1 + 0.4 * (turns > 1) * cos(turns * t));
            const double at = ring + thickness * cos(u);
            const double p[3] = {at * cos(loops * t), at * sin(loops * t),
                                 0.4 * radius * (turns > 1) * sin(turns * t) + thickness * sin(u)};
            double *v = own->vertices + 3 * own->n_vertices++;
            v[0] = p[0] + x;
            v[1] = upright ? p[2] : p[1];
            v[2] = (upright ? -p[1] : p[2]) + z;
        }
    for (uint32_t i = 0; i < LONG; ++i)
        for (uint32_t j = 0; j < ROUND; ++j) {
            const uint32_t a = ROUND * i, b = ROUND * ((i + 1) % LONG), k = (j + 1) % ROUND;
            surface_face(own, a + j, b + j, b + k);
            surface_face(own, a + j, b + k, a + k);
        }
    add_surface(kind);
}

START_TEST(linked_voids_and_knots_are_accepted)
{
    begin();
    add_torus(ICC_FEATURE_HOLE, -0.1, 0, 0.2, 0.03, 1, 1, false);
    add_torus(ICC_FEATURE_HOLE, 0.1, 0, 0.2, 0.03, 1, 1, true);
    icc_domain *d = make();
    ck_assert_uint_eq(info_of(d).genus, 2);
    ck_assert_uint_eq(info_of(d).n_voids, 2);
    icc_domain_free(d);
    begin();
    add_torus(ICC_FEATURE_REGION, 0, 0, 0.25, 0.02, 3, 2, false); /* a trefoil */
    d = make();
    ck_assert_uint_eq(info_of(d).genus, 0);
    ck_assert_uint_eq(feature_of(d, 0).genus, 1);
    icc_domain_free(d);
    octahedron(&s.outer, 0, 0, 0, 1);
    const surface knot = s.own[0];
    s.n = 0;
    s.outer = knot;
    add_point(0.25 * 1.4, 0, 0);
    d = make();
    ck_assert_uint_eq(info_of(d).genus, 1);
    icc_domain_free(d);
}
END_TEST

/* The outer surface has a void of its own, which may lie in a region. */
START_TEST(outer_surface_may_have_voids)
{
    for (int in_region = 0; in_region < 2; ++in_region) {
        begin();
        octahedron(&s.own[0], 0.25, 0, 0, 0.125);
        turn_over(&s.own[0]);
        for (size_t i = 0; i < 18; ++i)
            s.outer.vertices[18 + i] = s.own[0].vertices[i];
        for (size_t i = 0; i < 24; ++i)
            s.outer.faces[24 + i] = 6 + s.own[0].faces[i];
        s.outer.n_vertices = 12;
        s.outer.n_faces = 16;
        add_ball(ICC_FEATURE_REGION, in_region ? 0.25 : -0.25, 0, 0, 0.1875);
        icc_domain *d = make();
        ck_assert_uint_eq(info_of(d).n_voids, 1);
        ck_assert_uint_eq(info_of(d).n_pieces, 3);
        icc_domain_free(d);
        add_point(0.25, 0, 0);
        refuse(ICC_ERR_OUTSIDE, 1,
               "feature 1 (a point), vertex 0, lies in the void of the outer "
               "surface with face 8: move it out, since voids are empty");
        --s.n;
        s.features[0].kind = ICC_FEATURE_HOLE;
        if (in_region)
            refuse(ICC_ERR_OUTSIDE, 0,
                   "feature 0 (a void) goes around the void of the outer "
                   "surface with face 8: leave that one out");
    }
}
END_TEST

/* ----------------------------------------------------------------- refused */

START_TEST(places_outside_are_named)
{
    begin();
    add_ball(ICC_FEATURE_HOLE, 3, 0, 0, 0.1);
    refuse(ICC_ERR_OUTSIDE, 0,
           "feature 0 (a void), vertex 1, lies outside the outer surface: move it inside");
    begin();
    add_point(0, 0, 0);
    add_point(0.5, 0.5, 0.5);
    refuse(ICC_ERR_OUTSIDE, 1, "feature 1 (a point), vertex 0, lies outside the outer surface");
    begin();
    add_ball(ICC_FEATURE_REGION, 0, 0, 0, 3);
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a region), vertex 1, lies outside the outer surface");
    s.features[0].kind = ICC_FEATURE_HOLE;
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a void), vertex 1, lies outside the outer surface");
    begin();
    add_line(2, (const double[6]){2, 0, 0, 2, 1, 0});
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a line), vertex 0, lies outside the outer surface");
}
END_TEST

START_TEST(places_in_voids_are_named)
{
    static const char *const names[3] = {"a void", "a region", "a point"};
    for (int kind = 0; kind < 3; ++kind) {
        char text[160];
        begin();
        add_ball(ICC_FEATURE_HOLE, 0, 0, 0, 0.25);
        if (kind < 2)
            add_ball(kind == 0 ? ICC_FEATURE_HOLE : ICC_FEATURE_REGION, 0, 0, 0, 0.125);
        else
            add_point(0, 0, 0);
        (void)snprintf(text, sizeof text,
                       "feature 1 (%s), vertex %d, lies in feature 0 (a void): move it out, or "
                       "make the void a region",
                       names[kind], kind < 2);
        refuse(ICC_ERR_OUTSIDE, 1, text);
        s.features[0].kind = ICC_FEATURE_REGION;
        icc_domain_free(make());
    }
}
END_TEST

START_TEST(contacts_with_the_outer_surface_are_named)
{
    begin();
    add_ball(ICC_FEATURE_HOLE, 0.9, 0, 0, 0.2);
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a void), face ");
    begin();
    add_ball(ICC_FEATURE_REGION, 0.5, 0, 0, 0.5); /* touches at a vertex */
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a region), face ");
    begin();
    add_point(0.5, 0.25, 0.25);
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a point), vertex 0, meets the outer surface, face 0");
    begin();
    add_line(3, (const double[9]){0, 0, 0, 0.25, 0.125, 0, 0.5, 0.5, 0});
    refuse(ICC_ERR_OUTSIDE, 0, "feature 0 (a line), edge 1, meets the outer surface, face 0");
}
END_TEST

START_TEST(contacts_of_features_are_named)
{
    begin();
    add_ball(ICC_FEATURE_HOLE, 0, 0, 0, 0.3);
    add_ball(ICC_FEATURE_HOLE, 0.2, 0, 0, 0.3);
    refuse(ICC_ERR_BOUNDARY, 1, "feature 1 (a void), face ");
    begin();
    add_ball(ICC_FEATURE_REGION, 0, 0, 0, 0.25);
    add_line(2, (const double[6]){0, 0, 0, 0.5, 0.03, 0.02});
    refuse(ICC_ERR_BOUNDARY, 1, "feature 1 (a line), edge 0, meets feature 0 (a region), face ");
    begin();
    add_line(2, (const double[6]){-0.5, 0, 0, 0.5, 0, 0});
    add_line(3, (const double[9]){0.1, -0.5, 0.1, 0.1, -0.25, 0, 0.1, 0.25, 0});
    refuse(ICC_ERR_BOUNDARY, 1,
           "feature 1 (a line), edge 1, meets feature 0 (a line), edge 0, "
           "near (0.1, 0, 0): move it away");
    s.vertices[1][8] = 0x1p-60;
    s.vertices[1][5] = 0x1p-60;
    icc_domain_free(make());
    begin();
    add_line(2, (const double[6]){-0.5, 0, 0, 0.5, 0, 0});
    add_point(0.125, 0, 0);
    refuse(ICC_ERR_BOUNDARY, 1, "feature 1 (a point), vertex 0, meets feature 0 (a line), edge 0");
    begin();
    add_point(0.125, 0, 0);
    add_point(0.125, 0, 0);
    refuse(ICC_ERR_BOUNDARY, 1,
           "feature 1 (a point), vertex 0, meets feature 0 (a point), vertex 0");
}
END_TEST

START_TEST(lines_that_meet_themselves_are_named)
{
    begin();
    add_line(3, (const double[9]){0, 0, 0, 0.5, 0, 0, 0.25, 0, 0});
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a line): the line meets itself: edges 0 and 1");
    begin();
    add_line(3, (const double[9]){0.25, 0, 0, 0.5, 0, 0, 0, 0, 0});
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a line): the line meets itself: edges 0 and 1");
    begin();
    add_line(4, (const double[12]){0, 0, 0, 0.5, 0, 0, 0, 0.25, 0, 0, 0, 0});
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a line): the line meets itself: edges 0 and 2");
    begin();
    add_line(3, (const double[9]){0, 0, 0, 0.5, 0, 0, 0.5, 0, 0});
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a line): vertex 2 repeats the vertex before it");
    begin();
    add_line(2, (const double[6]){0, 0, NAN, 0.5, 0, 0});
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a line): vertex 0 is not finite");
}
END_TEST

START_TEST(surfaces_that_are_not_closed_are_named)
{
    begin();
    add_ball(ICC_FEATURE_HOLE, 0, 0, 0, 0.25);
    s.features[0].n_facets = 7;
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a void): edge ");
    s.features[0].n_facets = 3;
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a void): a closed surface has at least 4 faces, not 3");
    s.features[0].n_facets = 8;
    s.features[0].n_vertices = 5;
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a void): face ");
    s.features[0].n_vertices = 7;
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a void): vertex 6 belongs to no face: leave it out");
    s.features[0].n_vertices = 6;
    memcpy(s.own[0].vertices, s.own[0].vertices + 6, 3 * sizeof(double));
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a void): face ");
    octahedron(&s.own[0], 0, 0, 0, 0.25);
    memcpy(s.own[0].vertices, (const double[3]){-0.3, 0.2, 0.2}, 3 * sizeof(double));
    refuse(ICC_ERR_BOUNDARY, 0, "feature 0 (a void): the surface meets itself: faces ");
    begin();
    octahedron(&s.own[0], -0.25, 0, 0, 0.125);
    octahedron(&s.own[1], 0.25, 0, 0, 0.125);
    memcpy(s.own[0].vertices + 18, s.own[1].vertices, 18 * sizeof(double));
    for (size_t i = 0; i < 24; ++i)
        s.own[0].faces[24 + i] = 6 + s.own[1].faces[i];
    s.own[0].n_vertices = 12;
    s.own[0].n_faces = 16;
    add_surface(ICC_FEATURE_HOLE);
    refuse(ICC_ERR_TOPOLOGY, 0, "feature 0 (a void): the boundary has more than one component");
}
END_TEST

/* The distance of the middles of two features in the norm whose spheres are octahedra. */
static int distance(const int *a, const int *b)
{
    return abs(a[0] - b[0]) + abs(a[1] - b[1]) + abs(a[2] - b[2]);
}

/* What a feature is, with a radius of 0 for points. Entry 0 is the outer surface. */
typedef struct blob {
    int at[3], radius;
    int32_t kind;
} blob;

/* Returns the innermost surface around blob k, or -1. */
static int blob_around(const blob *blobs, int n, int k)
{
    int around = -1;
    for (int i = 0; i < n; ++i)
        if (i != k && blobs[i].radius > blobs[k].radius &&
            distance(blobs[i].at, blobs[k].at) < blobs[i].radius - blobs[k].radius &&
            (around < 0 || blobs[i].radius < blobs[around].radius))
            around = i;
    return around;
}

static bool blobs_meet(const blob *blobs, int n)
{
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < i; ++j) {
            const int d = distance(blobs[i].at, blobs[j].at);
            const int least = abs(blobs[i].radius - blobs[j].radius);
            if (least <= d && d <= blobs[i].radius + blobs[j].radius)
                return true;
        }
    return false;
}

static void add_blob(const blob *b)
{
    const double x[3] = {b->at[0] / 64.0, b->at[1] / 64.0, b->at[2] / 64.0};
    if (b->kind == ICC_FEATURE_POINT)
        add_line(1, x);
    else
        add_ball(b->kind, x[0], x[1], x[2], b->radius / 64.0);
}

/* Octahedra and points on a lattice. Returns whether they are accepted. */
static bool try_blobs(random_source *r, int n)
{
    static const int32_t kinds[4] = {ICC_FEATURE_HOLE, ICC_FEATURE_POINT, ICC_FEATURE_REGION,
                                     ICC_FEATURE_REGION};
    blob blobs[MOST_FEATURES + 1] = {{{0, 0, 0}, 64, ICC_FEATURE_REGION}};
    uint32_t region[MOST_FEATURES + 1] = {0}, n_regions = 0;
    icc_error err = {.size = sizeof err};
    icc_domain *d;
    begin();
    for (int k = 1; k < n; ++k) {
        blob *b = &blobs[k];
        b->kind = kinds[random_below(r, 4)];
        b->radius = b->kind == ICC_FEATURE_POINT ? 0 : 1 + random_below(r, k == 1 ? 50 : 12);
        for (int i = 0; i < 3; ++i)
            b->at[i] = random_below(r, k == 1 ? 3 : 49) - (k == 1 ? 1 : 24);
        region[k] = b->kind == ICC_FEATURE_REGION ? ++n_regions : 0;
        add_blob(b);
    }
    bool outside = false;
    for (int k = 1; k < n; ++k) {
        const int around = blob_around(blobs, n, k);
        outside |= around < 0 || blobs[around].kind == ICC_FEATURE_HOLE;
    }
    const icc_status status = create(&d, NULL, &err);
    if (blobs_meet(blobs, n))
        ck_assert(status == ICC_ERR_BOUNDARY || status == ICC_ERR_OUTSIDE);
    else
        ck_assert_int_eq(status, outside ? ICC_ERR_OUTSIDE : ICC_OK);
    for (int k = 1; k < n && status == ICC_OK; ++k)
        ck_assert_uint_eq(feature_of(d, (size_t)k - 1).around, region[blob_around(blobs, n, k)]);
    icc_domain_free(d);
    return status == ICC_OK;
}

START_TEST(nesting_is_as_brute_force_says)
{
    random_source r = {7};
    int n_accepted = 0;
    for (int i = 0; i < share_of(20000); ++i)
        n_accepted += try_blobs(&r, 2 + random_below(&r, 5));
    ck_assert_int_gt(n_accepted, share_of(1000));
}
END_TEST

START_TEST(arguments_are_checked)
{
    icc_domain *d;
    icc_error err = {.size = sizeof err};
    begin();
    add_point(0, 0, 0);
    s.features[0].n_facets = 1;
    refuse(ICC_ERR_ARGUMENT, 0, "feature 0 has facets, but lines and points have none");
    begin();
    add_ball(ICC_FEATURE_HOLE, 0, 0, 0, 0.25);
    s.features[0].facets = NULL;
    refuse(ICC_ERR_ARGUMENT, 0, "feature 0 has no facets, but it is a surface");
    s.features[0].n_vertices = 3;
    refuse(ICC_ERR_ARGUMENT, 0, "feature 0: a void has at least 4 vertices, not 3");
    s.features[0].kind = 5;
    refuse(ICC_ERR_ARGUMENT, 0, "feature 0: there is no kind 5");
    begin();
    add_point(0, 0, 0);
    s.features[0].radius = 0.1;
    refuse(ICC_ERR_ARGUMENT, 0, "feature 0: the radius is 0.1");
    ck_assert_int_eq(icc_domain_create_solid(&d, 0, NULL, 0, NULL, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_domain_create_solid(NULL, 0, NULL, 0, NULL, 0, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(
        icc_domain_create_solid(&d, 6, s.outer.vertices, 8, s.outer.faces, 1, NULL, NULL, &err),
        ICC_ERR_ARGUMENT);
}
END_TEST

/* Every operation on a domain: it works, or says by name why not. */
START_TEST(other_objects_refuse_them)
{
    icc_error err = {.size = sizeof err};
    icc_chart *chart;
    icc_match *match;
    icc_grid *grid;
    icc_shape *shape;
    icc_fit *fit;
    for (int kind = 0; kind < 2; ++kind) {
        begin();
        if (kind == 0)
            add_ball(ICC_FEATURE_HOLE, 0, 0, 0, 0.25);
        else
            add_point(0, 0, 0);
        icc_domain *d = make();
        ck_assert_int_eq(icc_chart_create(&chart, d, NULL, NULL, &err), ICC_ERR_UNSUPPORTED);
        ck_assert_ptr_nonnull(strstr(err.message, "voids, surfaces, lines or points inside"));
        ck_assert_int_eq(icc_grid_create(&grid, d, 0, NULL, &err), ICC_ERR_UNSUPPORTED);
        ck_assert_int_eq(icc_match_create(&match, d, d, 0, NULL, NULL, NULL, &err),
                         ICC_ERR_UNSUPPORTED);
        const icc_domain *regions[1] = {d};
        ck_assert_int_eq(icc_shape_create(&shape, 3, 1, regions, 0, NULL, 0, NULL, NULL, &err),
                         ICC_ERR_UNSUPPORTED);
        ck_assert_int_ne(icc_fit_create(&fit, d, NULL, 0, NULL, NULL, NULL, &err), ICC_OK);
        uint32_t region;
        ck_assert_int_eq(icc_domain_get_regions(d, &region), ICC_ERR_UNSUPPORTED);
        icc_domain_free(d);
    }
}
END_TEST

/* ------------------------------------------------------------------ meshes */

static cell_solid cells;

/* A void and a region with a region in it, in a block with a handle. */
static void make_cells(void)
{
    memset(&cells, 0, sizeof cells);
    cells.n_parts = 4;
    cells.is_void[1] = 1;
    cells.around[3] = 2;
    for (int x = 0; x < CELLS; ++x)
        for (int y = 0; y < CELLS; ++y)
            for (int z = 0; z < CELLS; ++z) {
                int *label = &cells.label[x][y][z];
                *label = x == 6 && y == 6 ? NO_CELL : 0;
                if (x > 0 && x < 3 && y > 0 && y < 3 && z > 0 && z < 3)
                    *label = 1;
                if (x > 3 && x < 7 && y > 0 && y < 4 && z > 0 && z < 6)
                    *label = x == 5 && y == 2 && z > 1 && z < 4 ? 3 : 2;
            }
    cell_solid_surfaces(&cells);
}

/* Makes the solid of the cells, with a line of two segments and a point. */
static icc_domain *make_cell_domain(void)
{
    static const int32_t kinds[4] = {0, ICC_FEATURE_HOLE, ICC_FEATURE_REGION, ICC_FEATURE_REGION};
    static const double line[9] = {2, 4, 4, 2, 6, 4, 2, 6, 6}, point[3] = {1, 5, 2};
    icc_feature features[5];
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    for (size_t k = 0; k < 3; ++k)
        features[k] = (icc_feature){.size = sizeof(icc_feature),
                                    .kind = kinds[k + 1],
                                    .n_vertices = cells.surface[k + 1].n_vertices,
                                    .vertices = cells.surface[k + 1].vertices,
                                    .n_facets = cells.surface[k + 1].n_facets,
                                    .facets = cells.surface[k + 1].facets};
    features[3] = (icc_feature){
        .size = sizeof(icc_feature), .kind = ICC_FEATURE_LINE, .n_vertices = 3, .vertices = line};
    features[4] = (icc_feature){
        .size = sizeof(icc_feature), .kind = ICC_FEATURE_POINT, .n_vertices = 1, .vertices = point};
    ck_assert_msg(icc_domain_create_solid(&domain, cells.surface[0].n_vertices,
                                          cells.surface[0].vertices, cells.surface[0].n_facets,
                                          cells.surface[0].facets, 5, features, NULL,
                                          &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

static iccp_env default_env(void)
{
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    return env;
}

static uint32_t point_at(double x, double y, double z)
{
    uint32_t v = 0;
    while (cells.points[3 * v] != x || cells.points[3 * v + 1] != y || cells.points[3 * v + 2] != z)
        ++v;
    return v;
}

/* Makes the mesh in local coordinates, with the middles of both segments on the line. */
static iccp_simplices *make_mesh(const icc_domain *solid, const iccp_env *env)
{
    iccp_simplices *mesh = iccp_alloc_zero(&env->memory, 1, sizeof *mesh);
    if (mesh == NULL)
        return NULL;
    mesh->memory = env->memory;
    mesh->dim = 3;
    mesh->n_points = cells.n_points;
    mesh->n_simplices = cells.n_tets;
    mesh->n_on_lines = 2;
    mesh->points = iccp_alloc(&env->memory, cells.n_points, 3 * sizeof *mesh->points);
    mesh->corners = iccp_alloc(&env->memory, cells.n_tets, 4 * sizeof *mesh->corners);
    mesh->on_line = iccp_alloc(&env->memory, 2, sizeof *mesh->on_line);
    if (mesh->points == NULL || mesh->corners == NULL || mesh->on_line == NULL) {
        iccp_simplices_free(mesh);
        return NULL;
    }
    for (size_t v = 0; v < cells.n_points; ++v)
        iccp_frame_in(&solid->frame, 3, cells.points + 3 * v, mesh->points + 3 * v);
    memcpy(mesh->corners, cells.tets, 4 * cells.n_tets * sizeof *mesh->corners);
    const uint32_t first = solid->features->item[3].first;
    mesh->on_line[0] = (iccp_on_line){point_at(2, 5, 4), first, first + 1, 0.5};
    mesh->on_line[1] = (iccp_on_line){point_at(2, 6, 5), first + 1, first + 2, 0.5};
    return mesh;
}

static icc_domain *begin_mesh(void)
{
    make_cells();
    icc_domain *solid = make_cell_domain();
    const icc_domain_info info = info_of(solid);
    double *vertices = malloc(3 * info.n_vertices * sizeof *vertices);
    ck_assert_int_eq(icc_domain_get_boundary(solid, vertices, NULL), ICC_OK);
    cell_solid_mesh(&cells, info.n_vertices, vertices);
    free(vertices);
    return solid;
}

static void check_regions(const icc_domain *filled)
{
    static const uint32_t wanted[4] = {0, UINT32_MAX, 1, 2};
    uint32_t *regions = malloc(cells.n_tets * sizeof *regions);
    ck_assert_uint_eq(info_of(filled).n_mesh_simplices, cells.n_tets);
    ck_assert_int_eq(icc_domain_get_regions(filled, regions), ICC_OK);
    for (size_t t = 0; t < cells.n_tets; ++t)
        ck_assert_uint_eq(regions[t], wanted[cells.part[t]]);
    free(regions);
}

START_TEST(meshes_are_numbered)
{
    const iccp_env env = default_env();
    icc_domain *solid = begin_mesh(), *filled;
    icc_error err = {.size = sizeof err};
    ck_assert_uint_eq(info_of(solid).genus, 1);
    ck_assert_msg(
        iccp_domain_create_solid_mesh(&filled, solid, make_mesh(solid, &env), &env, &err) == ICC_OK,
        "%s", err.message);
    check_regions(filled);
    const icc_domain_info a = info_of(solid), b = info_of(filled);
    ck_assert_uint_eq(a.n_vertices, b.n_vertices);
    ck_assert_uint_eq(a.n_facets, b.n_facets);
    ck_assert_double_eq(a.measure, b.measure);
    icc_mesh mesh = {.size = sizeof mesh};
    ck_assert_int_eq(icc_domain_get_mesh(filled, &mesh), ICC_OK);
    ck_assert_uint_eq(mesh.n_vertices, cells.n_points);
    icc_domain_free(filled);
    icc_domain_free(solid);
    cell_solid_free(&cells);
}
END_TEST

/* Each wrong mesh, and a part of what is said of it. */
START_TEST(wrong_meshes_are_refused)
{
    static const char *const texts[] = {"not positive",
                                        "names vertex",
                                        "belongs to no tetrahedron",
                                        "not that of the solid",
                                        "",
                                        "points on lines are not in order",
                                        "points on lines are not in order",
                                        "points on lines are not in order",
                                        "not an edge of the mesh",
                                        "lacks a face of an inner surface"};
    const iccp_env env = default_env();
    icc_domain *solid = begin_mesh(), *filled;
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        icc_error err = {.size = sizeof err};
        iccp_simplices *mesh = make_mesh(solid, &env);
        uint32_t *t = mesh->corners;
        const uint32_t swap = t[0];
        if (k == 0) {
            t[0] = t[1];
            t[1] = swap;
        } else if (k == 1) {
            t[0] = (uint32_t)mesh->n_points;
        } else if (k == 2) {
            mesh->n_simplices = 0; /* all but those at the last point */
            for (const uint32_t *c = cells.tets; c < cells.tets + 4 * cells.n_tets; c += 4) {
                bool has = false;
                for (int i = 0; i < 4; ++i)
                    has |= c[i] == cells.n_points - 1;
                if (!has)
                    memcpy(t + 4 * mesh->n_simplices++, c, 4 * sizeof *t);
            }
        } else if (k == 3) {
            mesh->points[0] += 1e-12;
        } else if (k == 4) {
            --mesh->n_simplices;
        } else if (k == 5) {
            mesh->on_line[0].share = 0.25;
        } else if (k == 6) {
            const iccp_on_line first = mesh->on_line[0];
            mesh->on_line[0] = mesh->on_line[1];
            mesh->on_line[1] = first;
        } else if (k == 7) {
            mesh->on_line[1] = mesh->on_line[0];
        } else if (k == 8) {
            mesh->n_on_lines = 1;
        } else {
            ++solid->facets[3 * solid->n_facets];
        }
        ck_assert_int_ne(iccp_domain_create_solid_mesh(&filled, solid, mesh, &env, &err), ICC_OK);
        ck_assert_ptr_null(filled);
        ck_assert_msg(strstr(err.message, texts[k]) != NULL, "%zu: %s", k, err.message);
    }
    icc_domain_free(solid);
    cell_solid_free(&cells);
}
END_TEST

static icc_status make_filled(const icc_env *given, icc_error *err, void *argument)
{
    const icc_domain *solid = argument;
    iccp_env env;
    icc_domain *filled;
    ck_assert_int_eq(iccp_env_read(&env, given, err), ICC_OK);
    iccp_simplices *mesh = make_mesh(solid, &env);
    if (mesh == NULL)
        return iccp_fail_memory(err);
    const icc_status status = iccp_domain_create_solid_mesh(&filled, solid, mesh, &env, err);
    icc_domain_free(filled);
    return status;
}

START_TEST(allocations_of_meshes_may_fail)
{
    icc_domain *solid = begin_mesh();
    faulty_sweep(make_filled, solid);
    icc_domain_free(solid);
    cell_solid_free(&cells);
}
END_TEST

/* ------------------------------------------------------------------- bytes */

static size_t save(icc_domain *domain, uint8_t *bytes, size_t capacity)
{
    iccp_blob w;
    size_t n;
    iccp_blob_begin(&w, bytes, capacity, "SOLI", 1);
    ck_assert_int_eq(iccp_domain_visit_any(&w, &domain, NULL), ICC_OK);
    iccp_blob_end(&w, &n);
    return n;
}

static icc_status load(icc_domain **out, const uint8_t *bytes, size_t n, const iccp_env *env)
{
    iccp_blob r;
    *out = NULL;
    icc_status status = iccp_blob_open(&r, bytes, n, "SOLI", 1, &env->memory, NULL);
    if (status == ICC_OK)
        status = iccp_domain_visit_any(&r, out, env);
    if (status == ICC_OK && !iccp_blob_done(&r))
        status = ICC_ERR_FORMAT;
    return status;
}

START_TEST(domains_come_back_from_their_bytes)
{
    const iccp_env env = default_env();
    icc_domain *solid = begin_mesh(), *filled, *again;
    ck_assert_int_eq(
        iccp_domain_create_solid_mesh(&filled, solid, make_mesh(solid, &env), &env, NULL), ICC_OK);
    for (int k = 0; k < 2; ++k) {
        icc_domain *d = k == 0 ? solid : filled;
        const size_t n = save(d, NULL, 0);
        uint8_t *bytes = malloc(n), *other = malloc(n);
        ck_assert_uint_eq(save(d, bytes, n), n);
        ck_assert_int_eq(load(&again, bytes, n, &env), ICC_OK);
        ck_assert_uint_eq(save(again, other, n), n);
        ck_assert_mem_eq(bytes, other, n);
        if (k == 1)
            check_regions(again);
        icc_domain_free(again);
        free(bytes);
        free(other);
    }
    icc_domain_free(filled);
    icc_domain_free(solid);
    cell_solid_free(&cells);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("solid");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, everything_is_accepted);
    tcase_add_test(tests, boundary_is_as_given);
    tcase_add_test(tests, points_are_located);
    tcase_add_test(tests, allocations_and_patience_may_end);
    tcase_add_test(tests, no_features_make_a_plain_domain);
    tcase_add_test(tests, linked_voids_and_knots_are_accepted);
    tcase_add_test(tests, outer_surface_may_have_voids);
    tcase_add_test(tests, places_outside_are_named);
    tcase_add_test(tests, places_in_voids_are_named);
    tcase_add_test(tests, contacts_with_the_outer_surface_are_named);
    tcase_add_test(tests, contacts_of_features_are_named);
    tcase_add_test(tests, lines_that_meet_themselves_are_named);
    tcase_add_test(tests, surfaces_that_are_not_closed_are_named);
    tcase_add_test(tests, nesting_is_as_brute_force_says);
    tcase_add_test(tests, arguments_are_checked);
    tcase_add_test(tests, other_objects_refuse_them);
    tcase_add_test(tests, meshes_are_numbered);
    tcase_add_test(tests, wrong_meshes_are_refused);
    tcase_add_test(tests, allocations_of_meshes_may_fail);
    tcase_add_test(tests, domains_come_back_from_their_bytes);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
