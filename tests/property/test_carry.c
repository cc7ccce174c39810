/* A caller's tetrahedral mesh carried along by a map: the certificate counts what is there, and the
 * repair leaves nothing inverted that could be mended. */
#include "../flat_mesh.h"
#include <check.h>
#include <icc/icc.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "../faulty.h"
#include "../mesh_domains.h"
#include "../meshes.h"
#include "../suite.h"

/* Another position of the vertices of a domain's boundary. */
static icc_domain *moved_domain(const icc_domain *domain, void (*move)(const double *x, double *y))
{
    icc_domain_info info = {.size = sizeof info};
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    const size_t dim = (size_t)info.dim;
    double *x = mesh_alloc(info.n_vertices * dim, sizeof *x);
    uint32_t *facets = mesh_alloc(info.n_facets * dim, sizeof *facets);
    ck_assert_int_eq(icc_domain_get_boundary(domain, x, facets), ICC_OK);
    for (size_t v = 0; v < info.n_vertices; ++v) {
        double y[ICC_MAX_DIM];
        move(x + dim * v, y);
        memcpy(x + dim * v, y, dim * sizeof *y);
    }
    icc_domain *moved;
    ck_assert_msg(icc_domain_create(&moved, info.dim, info.n_vertices, x, info.n_facets, facets,
                                    NULL, &err) == ICC_OK,
                  "%s", err.message);
    free(x);
    free(facets);
    return moved;
}

static icc_map *map_between(const icc_domain *source, const icc_domain *target, int32_t method,
                            int32_t cells)
{
    icc_error err = {.size = sizeof err};
    const icc_chart_options chart = {.size = sizeof chart, .method = method, .cells = cells};
    const icc_map_options options = {
        .size = sizeof options, .kind = ICC_MAP_CURVES, .chart = &chart};
    icc_map *map;
    ck_assert_msg(icc_map_create(&map, source, target, &options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return map;
}

/* Bends a ball of radius 1 to a crescent that is thin at its ends. */
static void bend(const double *x, double *y)
{
    const double angle = 1.3 * x[0], thin = 1.1 - 0.8 * x[0] * x[0],
                 radius = 1.2 + 0.6 * thin * x[1];
    y[0] = 2 * radius * sin(angle);
    y[1] = 2 * radius * cos(angle);
    y[2] = thin * x[2];
}

/* A little of that. */
static void lean(const double *x, double *y)
{
    y[0] = x[0] + 0.3 * x[1] * x[1];
    y[1] = x[1] + 0.2 * x[2] * x[0];
    y[2] = x[2];
}

/* Keeps 4-D as it is. */
static void stay(const double *x, double *y)
{
    memcpy(y, x, 4 * sizeof *y);
}

static long double determinant(const double *points, const uint32_t *v)
{
    long double e[3][3];
    for (size_t i = 0; i < 3; ++i)
        for (size_t k = 0; k < 3; ++k)
            e[i][k] = (long double)points[3 * v[i + 1] + k] - points[3 * v[0] + k];
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
           e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

/* Counted again; how many of the inverted ones have all corners on the boundary. */
static size_t check_counts(const test_mesh *m, const double *images, const icc_certificate *c,
                           const bool *on_rim)
{
    size_t n_inverted = 0, n_fixed = 0, n_no_image = 0;
    int64_t first = -1;
    for (size_t v = 0; v < m->n_vertices; ++v)
        n_no_image += isnan(images[3 * v]) != 0;
    for (size_t s = 0; s < m->n_simplices; ++s) {
        const uint32_t *v = m->simplices + 4 * s;
        const long double product = determinant(m->vertices, v) * determinant(images, v);
        size_t n_on_rim = 0;
        for (int k = 0; k < 4; ++k)
            n_on_rim += (size_t)on_rim[v[k]];
        n_inverted += product < 0;
        n_fixed += product < 0 && n_on_rim == 4;
        if (!(product > 0) && first < 0)
            first = (int64_t)s;
    }
    ck_assert_uint_eq(c->n_no_image, n_no_image);
    ck_assert_uint_eq(c->n_inverted, n_inverted);
    ck_assert_int_eq(c->first, first);
    ck_assert_int_eq(c->certified, first < 0 && c->boundary_simple);
    return n_fixed;
}

typedef struct result {
    double *mapped, *images;
    icc_certificate before, after;
} result;

static result carry(const icc_map *map, const test_mesh *m)
{
    icc_error err = {.size = sizeof err};
    result r = {.before = {.size = sizeof r.before}, .after = {.size = sizeof r.after}};
    r.mapped = mesh_alloc(3 * m->n_vertices, sizeof *r.mapped);
    r.images = mesh_alloc(3 * m->n_vertices, sizeof *r.images);
    ck_assert_msg(flat_certify(map, m->n_vertices, m->vertices, m->n_simplices, m->simplices,
                               r.mapped, &r.before, NULL, &err) == ICC_OK,
                  "%s", err.message);
    ck_assert_msg(flat_repair(map, m->n_vertices, m->vertices, m->n_simplices, m->simplices,
                              r.images, &r.after, NULL, &err) == ICC_OK,
                  "%s", err.message);
    return r;
}

static void result_free(result *r)
{
    free(r->mapped);
    free(r->images);
}

/* The vertices of cut balls, n cells along each axis, that lie on their boundary. */
static bool *list_rim(size_t n)
{
    const size_t n_vertices = (n + 1) * (n + 1) * (n + 1);
    bool *on_rim = mesh_alloc(n_vertices, sizeof *on_rim);
    for (size_t v = 0; v < n_vertices; ++v) {
        on_rim[v] = false;
        for (size_t k = 0, rest = v; k < 3; ++k, rest /= n + 1)
            on_rim[v] |= rest % (n + 1) == 0 || rest % (n + 1) == n;
    }
    return on_rim;
}

START_TEST(balls_are_certified_and_repaired)
{
    random_source r = {1};
    size_t n_mended = 0, n_certified = 0;
    for (size_t n = 3; n <= 9; ++n)
        for (int kind = 0; kind < 2; ++kind) {
            test_mesh m = mesh_ball(3, n, 0.1, &r);
            icc_domain *source = domain_of_mesh(&m),
                       *target = moved_domain(source, kind ? bend : lean);
            icc_map *map = map_between(source, target, ICC_METHOD_FIELD, 12);
            bool *on_rim = list_rim(n);
            result got = carry(map, &m);
            (void)check_counts(&m, got.mapped, &got.before, on_rim);
            const size_t n_fixed = check_counts(&m, got.images, &got.after, on_rim);
            ck_assert_int_eq(got.before.boundary_simple, 1);
            if (got.after.n_inverted != n_fixed)
                ck_abort_msg("n %zu, kind %d: %zu of %zu inverted before, %zu after, %zu of them "
                             "on the boundary",
                             n, kind, got.before.n_inverted, m.n_simplices, got.after.n_inverted,
                             n_fixed);
            for (size_t v = 0; v < m.n_vertices; ++v)
                if (got.before.certified || on_rim[v])
                    ck_assert_mem_eq(got.images + 3 * v, got.mapped + 3 * v, 3 * sizeof(double));
            n_mended += got.before.n_inverted - n_fixed;
            n_certified += got.after.certified == 1;
            free(on_rim);
            result_free(&got);
            icc_map_free(map);
            icc_domain_free(source);
            icc_domain_free(target);
            mesh_free(&m);
        }
    ck_assert(n_mended > 0 && n_certified > 0);
}
END_TEST

/* In whatever way the simplices list their corners. */
START_TEST(listing_does_not_matter)
{
    random_source r = {2};
    test_mesh m = mesh_ball(3, 5, 0.1, &r);
    icc_domain *source = domain_of_mesh(&m), *target = moved_domain(source, bend);
    icc_map *map = map_between(source, target, ICC_METHOD_FIELD, 12);
    result a = carry(map, &m);
    for (size_t s = 0; s < m.n_simplices; ++s) {
        uint32_t *v = m.simplices + 4 * s;
        const size_t i = (size_t)random_below(&r, 4), j = (size_t)random_below(&r, 4);
        const uint32_t swap = v[i];
        v[i] = v[j];
        v[j] = swap;
    }
    result b = carry(map, &m);
    ck_assert(a.before.n_inverted == b.before.n_inverted && a.before.first == b.before.first);
    ck_assert_uint_eq(a.after.n_inverted, b.after.n_inverted);
    result_free(&a);
    result_free(&b);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    mesh_free(&m);
}
END_TEST

/* The gradient method leaves points without an image; inner vertices get one, and those outside do
 * not. */
START_TEST(vertices_without_an_image)
{
    random_source r = {3};
    test_mesh m = mesh_ball(3, 8, 0.1, &r);
    icc_domain *source = domain_of_mesh(&m), *target = moved_domain(source, bend);
    icc_map *map = map_between(source, target, ICC_METHOD_GRADIENT, 4);
    result got = carry(map, &m);
    ck_assert_msg(got.before.n_no_image > 0, "%zu %zu", got.before.n_no_image,
                  got.after.n_inverted);
    ck_assert(got.before.n_no_image > 0 && got.before.certified == 0);
    ck_assert(got.after.n_no_image == 0 && got.after.n_inverted < got.before.n_inverted);
    result_free(&got);
    /* A vertex of the boundary is outside. */
    for (int k = 0; k < 3; ++k)
        m.vertices[k] *= 1.5;
    got = carry(map, &m);
    ck_assert(got.after.n_no_image > 0 && got.after.certified == 0 &&
              got.after.boundary_simple == 0);
    ck_assert_mem_eq(got.images, got.mapped, 3 * m.n_vertices * sizeof(double));
    result_free(&got);
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    mesh_free(&m);
}
END_TEST

/* What is no mesh is judged, and left alone. */
START_TEST(meshes_that_are_none)
{
    random_source r = {4};
    test_mesh ball = mesh_ball(3, 4, 0.1, &r);
    icc_domain *source = domain_of_mesh(&ball), *target = moved_domain(source, bend);
    icc_map *map = map_between(source, target, ICC_METHOD_FIELD, 12);
    for (int kind = 0; kind < 4; ++kind) {
        test_mesh m = mesh_copy(&ball);
        uint32_t *last = m.simplices + 4 * (m.n_simplices - 1);
        if (kind == 0) /* twice the same */
            memcpy(last, m.simplices, 4 * sizeof *last);
        else if (kind == 1) /* a corner twice */
            last[0] = last[1];
        else if (kind == 2) /* a flat one */
            memcpy(m.vertices + 3 * (size_t)last[0], m.vertices + 3 * (size_t)last[3],
                   3 * sizeof(double));
        else /* overlapping ones */
            m.vertices[3 * 62] += 0.9;
        result got = carry(map, &m);
        ck_assert(got.after.certified == 0 && got.before.certified == 0);
        ck_assert_int_eq(got.after.boundary_simple, 0);
        ck_assert(kind != 1 ||
                  (got.before.n_flat == 1 && got.before.first <= (int64_t)m.n_simplices - 1));
        ck_assert(kind != 2 || got.before.n_flat > 0);
        ck_assert_mem_eq(got.images, got.mapped, 3 * m.n_vertices * sizeof(double));
        result_free(&got);
        mesh_free(&m);
    }
    icc_map_free(map);
    icc_domain_free(source);
    icc_domain_free(target);
    mesh_free(&ball);
}
END_TEST

START_TEST(bad_arguments_are_refused)
{
    random_source r = {5};
    test_mesh m = mesh_cube(3, 2, 0.1, &r), m4 = mesh_cube(4, 1, 0, &r);
    icc_domain *d = domain_of_mesh(&m), *d4 = domain_of_mesh(&m4), *t4 = moved_domain(d4, stay);
    icc_map *map = map_between(d, d, ICC_METHOD_FIELD, 8);
    icc_map *map4 = map_between(d4, t4, ICC_METHOD_GRADIENT, 4);
    double *images = mesh_alloc(4 * m4.n_vertices + 3 * m.n_vertices, sizeof *images);
    for (int repair = 0; repair < 2; ++repair) {
        icc_status (*const call)(const icc_map *, size_t, const double *, size_t, const uint32_t *,
                                 double *, icc_certificate *, const icc_env *, icc_error *) =
            repair ? flat_repair : flat_certify;
        icc_certificate c = {.size = sizeof c};
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(call(map4, m4.n_vertices, m4.vertices, m4.n_simplices, m4.simplices,
                              images, &c, NULL, &err),
                         ICC_ERR_UNSUPPORTED);
        ck_assert_int_eq(call(map, m.n_vertices - 1, m.vertices, m.n_simplices, m.simplices, images,
                              &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_ptr_nonnull(strstr(err.message, "tetrahedron"));
        ck_assert_int_eq(
            call(map, m.n_vertices, m.vertices, 0, m.simplices, images, &c, NULL, &err),
            ICC_ERR_ARGUMENT);
        ck_assert_int_eq(call(map, 3, m.vertices, 1, m.simplices, images, &c, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(
            call(map, m.n_vertices, m.vertices, SIZE_MAX, m.simplices, images, &c, NULL, &err),
            ICC_ERR_ARGUMENT);
    }
    free(images);
    icc_map_free(map);
    icc_map_free(map4);
    icc_domain_free(d);
    icc_domain_free(d4);
    icc_domain_free(t4);
    mesh_free(&m);
    mesh_free(&m4);
}
END_TEST

/* ---- failures ---- */

typedef struct job {
    icc_map *map;
    test_mesh m;
    double *images;
} job;

static icc_status run_job(const icc_env *env, icc_error *err, void *argument)
{
    const job *j = argument;
    icc_certificate c = {.size = sizeof c};
    const icc_status status = flat_repair(j->map, j->m.n_vertices, j->m.vertices, j->m.n_simplices,
                                          j->m.simplices, j->images, &c, env, err);
    ck_assert(status != ICC_OK || c.certified);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    random_source r = {6};
    job j = {.m = mesh_ball(3, 6, 0.1, &r)};
    icc_domain *source = domain_of_mesh(&j.m), *target = moved_domain(source, bend);
    j.map = map_between(source, target, ICC_METHOD_GRADIENT, 4);
    j.images = mesh_alloc(3 * j.m.n_vertices, sizeof *j.images);
    faulty_sweep(run_job, &j);
    free(j.images);
    icc_map_free(j.map);
    icc_domain_free(source);
    icc_domain_free(target);
    mesh_free(&j.m);
}
END_TEST

/* ---- real pairs ---- */

/* Only what has all its corners on the boundary stays inverted. */
START_TEST(real_pairs)
{
    static const char *const NAMES[] = {"t08_fox", "t06_spikes_sphere", "t01_cube_bend"};
    static const int32_t METHODS[] = {ICC_METHOD_FIELD, ICC_METHOD_FOLIATION};
    for (size_t k = 0; k < 2 * sizeof NAMES / sizeof *NAMES; ++k) {
        test_mesh m, to;
        if (!mesh_of_data(&m, NAMES[k / 2], "src", "test_carry"))
            continue;
        ck_assert(mesh_of_data(&to, NAMES[k / 2], "tgt", "test_carry"));
        icc_domain *source = domain_of_mesh(&m), *target = domain_of_mesh(&to);
        icc_domain_info info = {.size = sizeof info};
        ck_assert_int_eq(icc_domain_get_info(target, &info), ICC_OK);
        icc_map *map = map_between(source, target, METHODS[k % 2], 0);
        bool *on_rim = mesh_alloc(m.n_vertices, sizeof *on_rim);
        for (size_t v = 0; v < m.n_vertices; ++v)
            on_rim[v] = v < info.n_vertices;
        result got = carry(map, &m);
        (void)check_counts(&m, got.mapped, &got.before, on_rim);
        const size_t n_fixed = check_counts(&m, got.images, &got.after, on_rim);
        free(on_rim);
        ck_assert_int_eq(got.after.boundary_simple, 1);
        ck_assert_uint_gt(got.before.n_inverted, n_fixed);
        ck_assert_uint_eq(got.after.n_inverted, n_fixed);
        result_free(&got);
        icc_map_free(map);
        icc_domain_free(source);
        icc_domain_free(target);
        mesh_free(&m);
        mesh_free(&to);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("carry");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, balls_are_certified_and_repaired);
    tcase_add_test(tests, listing_does_not_matter);
    tcase_add_test(tests, vertices_without_an_image);
    tcase_add_test(tests, meshes_that_are_none);
    tcase_add_test(tests, bad_arguments_are_refused);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, real_pairs);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
