/* Meshes that follow a network, and meshes that pretend to. */
#include "../../../default_env.h"
#include "../../../domains.h"
#include "../../../faulty.h"
#include "../../../suite.h"
#include "base/error.h"
#include "domain/network.h"
#include "map/compatible/flips.h"
#include "map/compatible/improve.h"
#include "map/compatible/network_rows.h"
#include "map/plane/plane_certificate.h"

/* A square. Two lines from corner to corner share its middle, and a third one ends there. */
static icc_domain *cross_domain(double x, double y)
{
    const double outer[] = {0, 0, 4, 0, 4, 4, 0, 4};
    const double first[] = {0, 0, x, y, 4, 4}, second[] = {4, 0, x, y, 0, 4};
    const double third[] = {x, y, 1, 2}, point[] = {2, 1};
    const icc_feature features[] = {
        {.size = sizeof *features, .kind = ICC_FEATURE_LINE, .n_vertices = 3, .vertices = first},
        {.size = sizeof *features, .kind = ICC_FEATURE_POINT, .n_vertices = 1, .vertices = point},
        {.size = sizeof *features, .kind = ICC_FEATURE_LINE, .n_vertices = 3, .vertices = second},
        {.size = sizeof *features, .kind = ICC_FEATURE_LINE, .n_vertices = 2, .vertices = third}};
    icc_domain *domain;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_domain_create_features(&domain, 4, outer, 4, features, NULL, &err) == ICC_OK,
                  "%s", err.message);
    return domain;
}

/* Vertices of the mesh: the corners, the middle, the end of the third line, the point. */
enum { MIDDLE = 4, END = 5, POINT = 6, N_VERTICES = 7 };
static const uint32_t TRIANGLES[] = {0, 1, 6, 1, 4, 6, 4, 0, 6, 1, 2, 4,
                                     2, 3, 4, 3, 5, 4, 0, 4, 5, 0, 5, 3};
/* The domain's vertex at each of them. */
static const uint32_t GIVEN[N_VERTICES] = {0, 1, 2, 3, 5, 12, 7};
enum { N_TRIANGLES = sizeof TRIANGLES / sizeof *TRIANGLES / 3 };

typedef struct fixture {
    icc_domain *source, *target;
    iccp_plmap map;
} fixture;

/* The map with the fewest triangles, whose edges are then cut. */
static fixture cross(size_t n_cuts)
{
    const iccp_env env = default_env();
    fixture f = {cross_domain(2, 2), cross_domain(2.5, 2.25), {.stretch = 0}};
    bool is_manifold;
    ck_assert_int_eq(iccp_plmap_begin(&f.map, N_VERTICES, N_TRIANGLES, 1, &env.memory), ICC_OK);
    memcpy(f.map.corners.vertex, TRIANGLES, sizeof TRIANGLES);
    ck_assert_int_eq(iccp_find_twins(&f.map.corners, N_VERTICES, &is_manifold, &env), ICC_OK);
    ck_assert(is_manifold);
    iccp_plmap_fix_none(&f.map, f.source);
    for (size_t v = 0; v < N_VERTICES; ++v) {
        const size_t given = 2 * (size_t)GIVEN[v];
        memcpy(f.map.points + 2 * v, f.source->vertices + given, 2 * sizeof(double));
        memcpy(f.map.images + 2 * v, f.target->vertices + given, 2 * sizeof(double));
        iccp_plmap_fix_node(&f.map, v, GIVEN[v]);
    }
    for (uint32_t c = 0; c < n_cuts; ++c) {
        bool done;
        ck_assert_int_eq(iccp_plmap_cut(&f.map, c, &done), ICC_OK);
    }
    return f;
}

static void fixture_free(fixture *f)
{
    iccp_plmap_free(&f->map);
    icc_domain_free(f->source);
    icc_domain_free(f->target);
}

static bool follows(const fixture *f)
{
    const iccp_env env = default_env();
    bool is;
    ck_assert_int_eq(iccp_check_rows(&is, &f->map, f->target, &env), ICC_OK);
    return is;
}

/* What the certificate of a map checks. */
static bool is_certified(const fixture *f)
{
    const iccp_env env = default_env();
    const icc_status status = iccp_plmap_certify(&f->map, &env, NULL);
    ck_assert(status == ICC_OK || status == ICC_ERR_CERTIFICATE);
    return status == ICC_OK && follows(f);
}

/* Returns a vertex between nodes, or a free one. */
static uint32_t find_vertex(const fixture *f, uint8_t kind)
{
    uint32_t v = N_VERTICES;
    while (v < f->map.n_vertices && f->map.fixed[v] != kind)
        ++v;
    ck_assert_uint_lt(v, f->map.n_vertices);
    return v;
}

/* Returns a corner that faces an edge of a line inside. */
static uint32_t find_line(const fixture *f)
{
    uint32_t c = 0;
    while (!iccp_plmap_is_line(&f->map, c) || f->map.corners.twin[c] == ICCP_NO_NEIGHBOUR)
        ++c;
    return c;
}

enum { N_CUTS = 60 };

START_TEST(meshes_that_follow)
{
    const iccp_env env = default_env();
    for (size_t n_cuts = 0; n_cuts <= N_CUTS; n_cuts += 20) {
        fixture f = cross(n_cuts);
        uint32_t vertex[13];
        size_t n;
        ck_assert(is_certified(&f));
        ck_assert(iccp_plmap_find_vertices(&f.map, vertex));
        for (uint32_t v = 0; v < N_VERTICES; ++v)
            ck_assert_uint_eq(vertex[GIVEN[v]], v);
        ck_assert_uint_eq(vertex[9], MIDDLE);
        ck_assert_uint_eq(vertex[11], MIDDLE);
        ck_assert_int_eq(iccp_flip_edges(&f.map, &n, &env), ICC_OK);
        ck_assert(is_certified(&f));
        fixture_free(&f);
    }
}
END_TEST

START_TEST(places_of_nodes_and_edges)
{
    fixture f = cross(0);
    uint32_t facet;
    double from, to;
    ck_assert_uint_eq(iccp_plmap_node(&f.map, MIDDLE), 5);
    ck_assert_uint_eq(iccp_plmap_node(&f.map, POINT), 7);
    ck_assert(iccp_plmap_on_line(&f.map, MIDDLE, END, &facet, &from, &to));
    ck_assert(from <= 0 && to >= 1);
    const uint32_t third = facet;
    ck_assert(iccp_plmap_on_line(&f.map, END, MIDDLE, &facet, &from, &to));
    ck_assert(facet == third && from >= 1 && to <= 0);
    ck_assert(iccp_plmap_on_line(&f.map, 0, 1, &facet, &from, &to));
    ck_assert_uint_eq(facet, 0);
    ck_assert(!iccp_plmap_on_line(&f.map, 0, 2, &facet, &from, &to));
    ck_assert(!iccp_plmap_on_line(&f.map, 0, POINT, &facet, &from, &to));
    fixture_free(&f);
}
END_TEST

/* ---- ways to cheat ---- */

START_TEST(flipped_line)
{
    const iccp_env env = default_env();
    size_t n_flipped = 0, n_corners = 1;
    for (uint32_t c = 0; c < n_corners; ++c) {
        fixture f = cross(N_CUTS);
        n_corners = 3 * f.map.corners.n_triangles;
        if (iccp_plmap_is_line(&f.map, c) && f.map.corners.twin[c] != ICCP_NO_NEIGHBOUR) {
            iccp_flip_edge(&f.map.corners, c);
            if (iccp_plmap_is_positive(&f.map)) {
                ++n_flipped;
                ck_assert_int_eq(iccp_plmap_certify(&f.map, &env, NULL), ICC_OK);
            }
            ck_assert(!follows(&f));
        }
        fixture_free(&f);
    }
    ck_assert_uint_gt(n_flipped, 0);
}
END_TEST

/* Moves a vertex on one side or on both. */
static void check_moved(uint32_t vertex, double by, bool both)
{
    fixture f = cross(N_CUTS);
    f.map.images[2 * (size_t)vertex] += by;
    if (both)
        f.map.points[2 * (size_t)vertex] += by;
    ck_assert(!is_certified(&f));
    fixture_free(&f);
}

START_TEST(moved_vertices)
{
    fixture f = cross(N_CUTS);
    const uint32_t on_line = find_vertex(&f, ICCP_ON_NETWORK);
    const uint32_t inner = find_vertex(&f, ICCP_FREE);
    fixture_free(&f);
    for (int both = 0; both < 2; ++both) {
        check_moved(MIDDLE, 1e-7, both);
        check_moved(POINT, 1e-7, both);
        check_moved(END, 1e-7, both);
        check_moved(0, 1e-7, both);
        check_moved(on_line, 1e-6, both);
        check_moved(inner, 10, both);
    }
}
END_TEST

/* A vertex says that it has another share of its side, or is on another one, or no node. */
START_TEST(false_places)
{
    fixture f = cross(N_CUTS);
    const uint32_t v = find_vertex(&f, ICCP_ON_NETWORK);
    const double along = f.map.along[v];
    const uint32_t facet = f.map.facet[v];
    f.map.along[v] = 0.5 * along;
    ck_assert(!is_certified(&f));
    f.map.along[v] = along;
    for (uint32_t other = 0; other < f.source->features->n_places; ++other) {
        f.map.facet[v] = other;
        ck_assert_int_eq(is_certified(&f), other == facet);
    }
    f.map.facet[v] = facet;
    f.map.fixed[v] = ICCP_FREE;
    ck_assert(!is_certified(&f));
    f.map.fixed[v] = ICCP_ON_POINT;
    ck_assert(!is_certified(&f));
    f.map.fixed[v] = ICCP_ON_NETWORK;
    ck_assert(is_certified(&f));
    /* A node at the end of another side than its place is the same node, but saved otherwise. */
    const uint32_t place = f.map.facet[MIDDLE];
    f.map.facet[MIDDLE] = f.map.facet[END];
    f.map.along[MIDDLE] = 1 - f.map.along[END];
    ck_assert_uint_eq(iccp_plmap_node(&f.map, MIDDLE), 5);
    ck_assert(!is_certified(&f));
    ck_assert_uint_ne(place, f.map.facet[MIDDLE]);
    fixture_free(&f);
}
END_TEST

/* One triangle is missing. */
START_TEST(hole)
{
    for (size_t n_cuts = 0; n_cuts <= N_CUTS; n_cuts += N_CUTS) {
        fixture f = cross(n_cuts);
        iccp_corners *c = &f.map.corners;
        const uint32_t last = 3 * (uint32_t)--c->n_triangles;
        for (uint32_t k = last; k < last + 3; ++k)
            if (c->twin[k] != ICCP_NO_NEIGHBOUR)
                c->twin[c->twin[k]] = ICCP_NO_NEIGHBOUR;
        ck_assert(!follows(&f));
        ck_assert(!is_certified(&f));
        fixture_free(&f);
    }
}
END_TEST

/* The triangles at a line do not know each other. Then one side gets its own copy of a vertex. */
START_TEST(crack)
{
    fixture f = cross(N_CUTS);
    iccp_corners *c = &f.map.corners;
    const uint32_t corner = find_line(&f), twin = c->twin[corner];
    c->twin[corner] = c->twin[twin] = ICCP_NO_NEIGHBOUR;
    ck_assert(!follows(&f));
    ck_assert(!is_certified(&f));
    fixture_free(&f);
    f = cross(N_CUTS);
    const uint32_t v = find_vertex(&f, ICCP_FREE);
    uint32_t x = 0;
    while (f.map.corners.vertex[x] != v)
        ++x;
    f.map.corners.vertex[x] = (uint32_t)f.map.n_vertices - 1;
    ck_assert(!is_certified(&f));
    fixture_free(&f);
}
END_TEST

/* A triangle is there twice, or in place of another. */
START_TEST(triangle_twice)
{
    for (int replaces = 0; replaces < 2; ++replaces) {
        fixture f = cross(N_CUTS);
        iccp_corners *c = &f.map.corners;
        const size_t last = 3 * (c->n_triangles - 1);
        c->n_triangles -= (size_t)(1 - replaces);
        memcpy(c->vertex + last, c->vertex, 3 * sizeof *c->vertex);
        for (size_t k = last; k < last + 3; ++k) {
            if (c->twin[k] != ICCP_NO_NEIGHBOUR)
                c->twin[c->twin[k]] = ICCP_NO_NEIGHBOUR;
            c->twin[k] = ICCP_NO_NEIGHBOUR;
        }
        ck_assert(!follows(&f));
        ck_assert(!is_certified(&f));
        fixture_free(&f);
    }
}
END_TEST

/* No triangle has a vertex, or a node has two. */
START_TEST(vertices_to_spare)
{
    for (int node = 0; node < 2; ++node) {
        fixture f = cross(N_CUTS);
        const size_t v = f.map.n_vertices - 1;
        bool done;
        ck_assert_int_eq(iccp_plmap_cut(&f.map, 0, &done), ICC_OK);
        iccp_plmap_copy_vertex(&f.map, v + 1, &f.map, node ? MIDDLE : find_vertex(&f, ICCP_FREE));
        ck_assert(!is_certified(&f));
        fixture_free(&f);
    }
}
END_TEST

static icc_status check(const icc_env *env, icc_error *err, void *argument)
{
    const fixture *f = argument;
    iccp_env full;
    bool is;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    icc_status status = iccp_plmap_certify(&f->map, &full, err);
    if (status == ICC_OK)
        status = iccp_check_rows(&is, &f->map, f->target, &full);
    return iccp_explain(err, status);
}

START_TEST(no_memory)
{
    fixture f = cross(N_CUTS);
    faulty_sweep(check, &f);
    fixture_free(&f);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("network_rows");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, meshes_that_follow);
    tcase_add_test(tests, places_of_nodes_and_edges);
    tcase_add_test(tests, flipped_line);
    tcase_add_test(tests, moved_vertices);
    tcase_add_test(tests, false_places);
    tcase_add_test(tests, hole);
    tcase_add_test(tests, crack);
    tcase_add_test(tests, triangle_twice);
    tcase_add_test(tests, vertices_to_spare);
    tcase_add_test(tests, no_memory);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
