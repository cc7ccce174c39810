/* Checking and repairing the images of meshes that are no ball: with holes, voids and handles, and
 * in several pieces. */
#include "../../faulty.h"
#include "../../flat_mesh.h"
#include "../../meshes.h"
#include "../../suite.h"

#include "domain/boundary_parts.h"
#include "domain/mesh_domain.h"

#include <check.h>
#include <icc/icc.h>
#include <math.h>
#include <stdbool.h>

/* ---- plates with holes ---- */

enum { MOST_HOLES = 5, SIDE = 40 };

/* Holes are rectangles of cells of a square of SIDE cells, apart from each other. */
typedef struct plate {
    int n_holes;
    int from[MOST_HOLES][2], to[MOST_HOLES][2];
} plate;

static plate current;

static bool is_free(const plate *p, const int *from, const int *to)
{
    for (int h = 0; h < p->n_holes; ++h)
        if (from[0] < p->to[h][0] + 6 && p->from[h][0] < to[0] + 6 && from[1] < p->to[h][1] + 6 &&
            p->from[h][1] < to[1] + 6)
            return false;
    return true;
}

static plate random_plate(int n_holes, random_source *r)
{
    plate p = {0};
    for (int tries = 1; p.n_holes < n_holes; ++tries) {
        if (tries % 100 == 0)
            p.n_holes = 0;
        int from[2], to[2];
        for (int k = 0; k < 2; ++k) {
            from[k] = 5 + random_below(r, SIDE - 16);
            to[k] = from[k] + 2 + random_below(r, 4);
        }
        if (!is_free(&p, from, to))
            continue;
        memcpy(p.from[p.n_holes], from, sizeof from);
        memcpy(p.to[p.n_holes++], to, sizeof to);
    }
    return p;
}

static bool is_in_hole(const plate *p, int x, int y, bool closed)
{
    for (int h = 0; h < p->n_holes; ++h)
        if (x >= p->from[h][0] && y >= p->from[h][1] && x < p->to[h][0] + closed &&
            y < p->to[h][1] + closed)
            return true;
    return false;
}

static int keep_plate(int32_t dim, const size_t *cell)
{
    (void)dim;
    return !is_in_hole(&current, (int)cell[0], (int)cell[1], false);
}

static test_mesh mesh_plate(const plate *p, double amount, random_source *r)
{
    current = *p;
    test_mesh m = mesh_cells(2, SIDE, keep_plate);
    for (size_t v = 0; v < m.n_vertices; ++v) {
        double *x = m.vertices + 2 * v;
        const bool is_inner = x[0] > 0 && x[1] > 0 && x[0] < SIDE && x[1] < SIDE &&
                              !is_in_hole(p, (int)x[0], (int)x[1], true);
        for (int k = 0; k < 2 && is_inner; ++k)
            x[k] += random_between(r, -amount, amount);
    }
    return m;
}

/* The plate itself, or with its holes turned, smaller, and the whole turned. */
static icc_domain *plate_domain(const plate *p, bool moved, random_source *r)
{
    double corners[MOST_HOLES + 1][8];
    icc_feature holes[MOST_HOLES];
    const double all = moved ? random_between(r, -3, 3) : 0;
    for (int h = 0; h <= p->n_holes; ++h) {
        const bool is_outer = h == p->n_holes;
        const double turn = moved && !is_outer ? random_between(r, -1, 1) : 0;
        const double size = moved && !is_outer ? random_between(r, 0.6, 0.9) : 1;
        for (int k = 0; k < 4; ++k) {
            const double share[2] = {k == 1 || k == 2, k >= 2};
            double middle[2], x[2], y[2];
            for (int i = 0; i < 2; ++i) {
                const double low = is_outer ? 0 : p->from[h][i], up = is_outer ? SIDE : p->to[h][i];
                middle[i] = (low + up) / 2;
                x[i] = size * (low + share[i] * (up - low) - middle[i]);
            }
            y[0] = middle[0] + cos(turn) * x[0] - sin(turn) * x[1];
            y[1] = middle[1] + sin(turn) * x[0] + cos(turn) * x[1];
            corners[h][2 * k] = moved ? cos(all) * y[0] - sin(all) * y[1] : y[0];
            corners[h][2 * k + 1] = moved ? sin(all) * y[0] + cos(all) * y[1] : y[1];
        }
        if (!is_outer)
            holes[h] = (icc_feature){.size = sizeof holes[h],
                                     .kind = ICC_FEATURE_HOLE,
                                     .n_vertices = 4,
                                     .vertices = corners[h]};
    }
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create_features(&domain, 4, corners[p->n_holes], (size_t)p->n_holes,
                                                holes, NULL, NULL),
                     ICC_OK);
    return domain;
}

static icc_map *map_of(icc_domain *source, icc_domain *target)
{
    icc_map *map;
    ck_assert_int_eq(icc_map_create(&map, source, target, NULL, NULL, NULL), ICC_OK);
    icc_domain_free(source);
    icc_domain_free(target);
    return map;
}

/* Triangles that are not positive, where long doubles can tell. */
static size_t count_faults(const test_mesh *m, const double *images)
{
    size_t n = 0;
    for (size_t t = 0; t < m->n_simplices; ++t) {
        const uint32_t *v = m->simplices + 3 * t;
        const double *a = images + 2 * v[0], *b = images + 2 * v[1], *c = images + 2 * v[2];
        const long double area = ((long double)b[0] - a[0]) * ((long double)c[1] - a[1]) -
                                 ((long double)b[1] - a[1]) * ((long double)c[0] - a[0]);
        ck_assert(fabsl(area) > 1e-15L);
        const double *p = m->vertices + 2 * v[0], *q = m->vertices + 2 * v[1],
                     *s = m->vertices + 2 * v[2];
        const double before = (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0]);
        n += (area > 0) != (before > 0);
    }
    return n;
}

START_TEST(plates_with_holes_are_certified_and_repaired)
{
    random_source r = {17};
    size_t n_before = 0, n_after = 0, n_plates = 0;
    for (int k = 0; k < 25; ++k) {
        const plate p = random_plate(1 + k % MOST_HOLES, &r);
        const bool moved = k >= MOST_HOLES;
        test_mesh m = mesh_plate(&p, 0.1, &r);
        icc_domain *source = plate_domain(&p, false, &r);
        icc_map *map = map_of(source, plate_domain(&p, moved, &r));
        double *images = mesh_alloc(2 * m.n_vertices, sizeof *images);
        icc_certificate before = {.size = sizeof before}, after = before;
        ck_assert_int_eq(flat_certify(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices,
                                      images, &before, NULL, NULL),
                         ICC_OK);
        ck_assert_uint_eq(before.n_inverted + before.n_flat, count_faults(&m, images));
        ck_assert_int_eq(before.boundary_simple, 1);
        ck_assert_int_eq(before.certified, before.n_inverted + before.n_flat == 0);
        ck_assert_int_eq(before.certified, before.message[0] == 0);
        ck_assert(moved || before.certified);
        ck_assert_int_eq(flat_repair(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices,
                                     images, &after, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(after.certified, count_faults(&m, images) == 0);
        n_before += (size_t)before.certified;
        n_after += (size_t)after.certified;
        ++n_plates;
        free(images);
        icc_map_free(map);
        mesh_free(&m);
    }
    ck_assert_uint_lt(n_before, n_plates);
    ck_assert_uint_eq(n_after, n_plates);
}
END_TEST

/* ---- other shapes ---- */

static const char *shape;

static bool is_between(size_t x, size_t from, size_t to)
{
    return x >= from && x < to;
}

/* Cells of a cube or square of 5 cells a side. */
static int keep_shape(int32_t dim, const size_t *c)
{
    const bool is_core =
        is_between(c[0], 2, 3) && is_between(c[1], 2, 3) && (dim == 2 || is_between(c[2], 2, 3));
    const bool is_middle =
        is_between(c[0], 1, 4) && is_between(c[1], 1, 4) && (dim == 2 || is_between(c[2], 1, 4));
    if (strcmp(shape, "hole or void") == 0)
        return !is_core;
    if (strcmp(shape, "handle") == 0)
        return !(is_between(c[0], 2, 3) && is_between(c[1], 2, 3));
    if (strcmp(shape, "two pieces") == 0)
        return c[0] != 2;
    if (strcmp(shape, "a piece within a hole or void") == 0)
        return is_core || !is_middle;
    if (strcmp(shape, "pieces that share a vertex") == 0)
        return (c[0] < 2) == (c[1] < 2) && (dim == 2 || (c[0] < 2) == (c[2] < 2));
    return 0;
}

static icc_domain *cube_domain(int32_t dim)
{
    test_mesh m = mesh_cells(dim, 5, NULL);
    icc_domain *domain;
    ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
    mesh_free(&m);
    return domain;
}

START_TEST(holes_voids_handles_and_pieces)
{
    static const char *const GOOD[] = {"hole or void", "handle", "two pieces",
                                       "a piece within a hole or void"};
    for (int32_t dim = 2; dim <= 3; ++dim) {
        icc_map *map = map_of(cube_domain(dim), cube_domain(dim));
        icc_certificate c = {.size = sizeof c};
        for (size_t k = 0; k < sizeof GOOD / sizeof *GOOD; ++k) {
            shape = GOOD[k];
            test_mesh m = mesh_cells(dim, 5, keep_shape);
            ck_assert_int_eq(flat_certify(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices,
                                          NULL, &c, NULL, NULL),
                             ICC_OK);
            if (!c.certified || c.message[0] != 0)
                ck_abort_msg("%s in %d-D: %s", shape, (int)dim, c.message);
            /* Once more in the same place: both are one-to-one, but together they are not. */
            test_mesh twice = mesh_of(dim, 2 * m.n_vertices, 2 * m.n_simplices);
            const size_t n = (size_t)dim * m.n_vertices,
                         n_corners = (size_t)(dim + 1) * m.n_simplices;
            memcpy(twice.vertices, m.vertices, n * sizeof(double));
            for (size_t i = 0; i < n; ++i)
                twice.vertices[n + i] = 2.5 + 0.125 * (m.vertices[i] - 2.5);
            memcpy(twice.simplices, m.simplices, n_corners * sizeof(uint32_t));
            for (size_t i = 0; i < n_corners; ++i)
                twice.simplices[n_corners + i] = m.simplices[i] + (uint32_t)m.n_vertices;
            ck_assert_int_eq(flat_certify(map, twice.n_vertices, twice.vertices, twice.n_simplices,
                                          twice.simplices, NULL, &c, NULL, NULL),
                             ICC_OK);
            /* A small copy fits into a hole, a void, a handle and the gap between two pieces. */
            const bool fits = k < 3;
            if (c.certified != fits || (c.message[0] == 0) != fits)
                ck_abort_msg("%s twice in %d-D: %s", shape, (int)dim, c.message);
            mesh_free(&twice);
            mesh_free(&m);
        }
        shape = "pieces that share a vertex";
        test_mesh m = mesh_cells(dim, 5, keep_shape);
        ck_assert_int_eq(flat_certify(map, m.n_vertices, m.vertices, m.n_simplices, m.simplices,
                                      NULL, &c, NULL, NULL),
                         ICC_OK);
        ck_assert(c.certified == (dim == 2) && c.boundary_simple == (dim == 2) && c.first == -1);
        ck_assert(c.certified || strstr(c.message, "vertex") != NULL);
        mesh_free(&m);
        icc_map_free(map);
    }
}
END_TEST

/* ---- places of the boundary ---- */

static icc_status check_at(const test_mesh *m, const double *points, icc_error *err)
{
    const iccp_env env = {.memory = iccp_memory_default};
    iccp_simplices *mesh;
    iccp_frame frame;
    iccp_boundary_parts boundary;
    ck_assert_int_eq(iccp_mesh_read(&mesh, &frame, (size_t)m->dim, m->n_vertices, m->vertices,
                                    m->n_simplices, m->simplices, 0, NULL, &env, err),
                     ICC_OK);
    ck_assert_int_eq(iccp_boundary_parts_create(&boundary, mesh, m->n_vertices, &env, err), ICC_OK);
    const icc_status status = iccp_boundary_parts_check(&boundary, points, &env, err);
    iccp_boundary_parts_free(&boundary);
    iccp_simplices_free(mesh);
    return status;
}

/* Moves the vertices with coordinates from 2 to 3, which are those of the core, by a rule. */
static test_mesh with_core(const test_mesh *m, double size, double shift)
{
    test_mesh moved = mesh_copy(m);
    for (size_t v = 0; v < m->n_vertices; ++v) {
        double *x = moved.vertices + (size_t)m->dim * v;
        bool is_core = true;
        for (int32_t k = 0; k < m->dim; ++k)
            is_core &= x[k] >= 2 && x[k] <= 3;
        for (int32_t k = 0; k < m->dim && is_core; ++k)
            x[k] = 2.5 + size * (x[k] - 2.5) + shift;
    }
    return moved;
}

/* One piece turns around the common vertex, until it lies beside the other or on it. */
START_TEST(pieces_that_share_a_vertex)
{
    static const struct {
        double turn[4];
        bool good;
    } CASES[] = {{{1, 0, 0, 1}, true},          {{0.5, 0, 0, 0.5}, true},
                 {{0, -1, 1, 0}, false},        {{-1, 0, 0, -1}, false},
                 {{-0.25, 0, 0, -0.25}, false}, {{0, 1, -1, 0}, false},
                 {{0.6, -0.8, 0.8, 0.6}, true}, {{-0.6, -0.8, 0.8, -0.6}, false}};
    shape = "pieces that share a vertex";
    test_mesh m = mesh_cells(2, 5, keep_shape);
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
        const double *turn = CASES[k].turn;
        icc_error err = {.size = sizeof err};
        test_mesh moved = mesh_copy(&m);
        for (size_t v = 0; v < m.n_vertices; ++v) {
            const double x = m.vertices[2 * v] - 2, y = m.vertices[2 * v + 1] - 2;
            if (x < 0 || y < 0)
                continue;
            moved.vertices[2 * v] = 2 + turn[0] * x + turn[1] * y;
            moved.vertices[2 * v + 1] = 2 + turn[2] * x + turn[3] * y;
        }
        ck_assert_int_eq(check_at(&m, moved.vertices, &err),
                         CASES[k].good ? ICC_OK : ICC_ERR_BOUNDARY);
        mesh_free(&moved);
    }
    mesh_free(&m);
}
END_TEST

START_TEST(each_point_lies_in_one_simplex_at_most)
{
    for (int32_t dim = 2; dim <= 3; ++dim) {
        static const struct {
            const char *name, *shape;
            double size, shift;
            bool good;
        } CASES[] = {
            {"a smaller hole", "hole or void", 0.125, 0, true},
            {"a hole outside", "hole or void", 1, 10, false},
            {"a hole around", "hole or void", 9, 0, false},
            {"a hole across", "hole or void", 1, 2.25, false},
            {"a hole that touches", "hole or void", 1, 2, false},
            {"a larger core", "a piece within a hole or void", 2, 0, true},
            {"a core elsewhere", "a piece within a hole or void", 1, 10, true},
            {"a core in another piece", "a piece within a hole or void", 0.125, 2.0625, false},
            {"a core around", "a piece within a hole or void", 9, 0, false},
            {"a core across", "a piece within a hole or void", 1, 1.25, false},
            {"a core that touches", "a piece within a hole or void", 1, 1, false}};
        for (size_t k = 0; k < sizeof CASES / sizeof *CASES; ++k) {
            icc_error err = {.size = sizeof err};
            shape = CASES[k].shape;
            test_mesh m = mesh_cells(dim, 5, keep_shape);
            test_mesh moved = with_core(&m, CASES[k].size, CASES[k].shift);
            const icc_status status = check_at(&m, moved.vertices, &err);
            if (status != (CASES[k].good ? ICC_OK : ICC_ERR_BOUNDARY))
                ck_abort_msg("%s in %d-D: %d, %s", CASES[k].name, (int)dim, (int)status,
                             err.message);
            mesh_free(&moved);
            mesh_free(&m);
        }
    }
}
END_TEST

typedef struct job {
    icc_map *map;
    test_mesh m;
} job;

static icc_status run_job(const icc_env *env, icc_error *err, void *argument)
{
    const job *j = argument;
    icc_certificate c = {.size = sizeof c};
    const icc_status status = flat_certify(j->map, j->m.n_vertices, j->m.vertices, j->m.n_simplices,
                                           j->m.simplices, NULL, &c, env, err);
    ck_assert(status != ICC_OK || c.certified == 1);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    for (int32_t dim = 2; dim <= 3; ++dim) {
        shape = "hole or void";
        job j = {map_of(cube_domain(dim), cube_domain(dim)), mesh_cells(dim, 5, keep_shape)};
        faulty_sweep(run_job, &j);
        mesh_free(&j.m);
        icc_map_free(j.map);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("certify_shapes");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, plates_with_holes_are_certified_and_repaired);
    tcase_add_test(tests, holes_voids_handles_and_pieces);
    tcase_add_test(tests, pieces_that_share_a_vertex);
    tcase_add_test(tests, each_point_lies_in_one_simplex_at_most);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
