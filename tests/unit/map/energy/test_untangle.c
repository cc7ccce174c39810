/* Meshes of triangles and of tetrahedra: in a tangle, and shaken maps made fair. */
#include <check.h>
#include <stdbool.h>
#include <stdlib.h>

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../meshes.h"
#include "../../../suite.h"
#include "domain/domain.h"
#include "geometry/simplices.h"
#include "map/compatible/improve.h"
#include "map/energy/mesh_repair.h"
#include "map/energy/newton.h"
#include "map/energy/patches.h"
#include "map/energy/untangle.h"
#include "math/orient.h"

/* A cube with n cells along each edge, 1 long where `unit`, its inner vertices shaken. */
typedef struct cube {
    icc_domain *domain;
    const iccp_simplices *mesh;
    size_t size; /* bytes of the images */
    double *start, *images;
} cube;

static cube cube_of(int32_t dim, size_t n, double amount, bool unit, random_source *r)
{
    icc_error err = {.size = sizeof err};
    cube c;
    test_mesh m = mesh_cube(dim, n, amount, r);
    for (size_t i = 0; unit && i < (size_t)dim * m.n_vertices; ++i)
        m.vertices[i] /= (double)n;
    ck_assert_msg(mesh_domain(&c.domain, &m, NULL, &err) == ICC_OK, "%s", err.message);
    mesh_free(&m);
    c.mesh = c.domain->mesh;
    c.size = (size_t)dim * c.mesh->n_points * sizeof *c.start;
    c.start = mesh_alloc(1, c.size);
    c.images = mesh_alloc(1, c.size);
    memcpy(c.start, c.mesh->points, c.size);
    memcpy(c.images, c.mesh->points, c.size);
    return c;
}

static void free_cube(cube *c)
{
    free(c->start);
    free(c->images);
    icc_domain_free(c->domain);
}

static size_t count_inverted(const cube *c)
{
    const size_t dim = c->mesh->dim;
    size_t n = 0;
    for (size_t s = 0; s < c->mesh->n_simplices; ++s) {
        const double *corner[4];
        for (size_t k = 0; k <= dim; ++k)
            corner[k] = c->images + dim * c->mesh->corners[(dim + 1) * s + k];
        n += iccp_orient(dim, corner) <= 0;
    }
    return n;
}

/* ---- tangles ---- */

static icc_status repair(const icc_env *env, icc_error *err, void *argument)
{
    cube *c = argument;
    iccp_env full;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    memcpy(c->images, c->start, c->size);
    const icc_status status = iccp_mesh_repair(c->mesh, c->images, HUGE_VAL, &full);
    if (err != NULL) {
        err->status = status;
        err->message[0] = 'x';
    }
    return status;
}

/* A bend of the unit cube that leaves no simplex of a fine mesh flat. */
static void bend(size_t dim, const double *x, double *y)
{
    const double angle = 2 * (x[0] - 0.5), radius = 1 + x[1];
    y[0] = radius * sin(angle);
    y[1] = radius * cos(angle);
    if (dim == 3)
        y[2] = x[2] * (1 + 0.5 * x[0]);
}

/* Inner vertices anywhere: in a heap, at random, or where they were before the bend. */
static void tangle(cube *c, int kind, random_source *r)
{
    const size_t dim = c->mesh->dim;
    for (size_t v = 0; v < c->mesh->n_points; ++v) {
        const double *x = c->mesh->points + dim * v;
        double *y = c->start + dim * v;
        bend(dim, x, y);
        for (size_t k = 0; k < dim && v >= c->mesh->n_boundary; ++k)
            y[k] = kind == 0   ? 0.5 + 1e-3 * random_unit(r)
                   : kind == 1 ? random_between(r, -1, 2)
                               : x[k];
    }
    memcpy(c->images, c->start, c->size);
}

START_TEST(tangles)
{
    random_source r = {4};
    for (int32_t dim = 2; dim <= 3; ++dim)
        for (size_t n = 4; n <= 7; ++n)
            for (int kind = 0; kind < 3; ++kind) {
                cube c = cube_of(dim, n, 0.1, true, &r);
                double *again = mesh_alloc(1, c.size);
                tangle(&c, kind, &r);
                ck_assert_uint_gt(count_inverted(&c), c.mesh->n_simplices / 20);
                ck_assert_int_eq(repair(NULL, NULL, &c), ICC_OK);
                if (count_inverted(&c) != 0)
                    ck_abort_msg("dim %d, n %zu, kind %d: %zu left of %zu", (int)dim, n, kind,
                                 count_inverted(&c), c.mesh->n_simplices);
                ck_assert_mem_eq(c.images, c.start,
                                 c.mesh->dim * c.mesh->n_boundary * sizeof(double));
                memcpy(again, c.images, c.size);
                ck_assert_int_eq(repair(NULL, NULL, &c), ICC_OK);
                ck_assert_mem_eq(c.images, again, c.size);
                free(again);
                free_cube(&c);
            }
}
END_TEST

/* Only what is in a tangle moves: a patch of two rings does here. */
START_TEST(what_is_far_away_stays)
{
    random_source r = {5};
    for (int32_t dim = 2; dim <= 3; ++dim) {
        cube c = cube_of(dim, 10, 0, false, &r);
        const size_t d = (size_t)dim;
        size_t moved = c.mesh->n_boundary;
        while (fabs(c.start[d * moved] - c.start[d * moved + 1]) > 0 ||
               fabs(c.start[d * moved] - c.start[d * moved + d - 1]) > 0)
            ++moved;
        c.start[d * moved] += 2.5 * c.start[d * moved];
        memcpy(c.images, c.start, c.size);
        ck_assert_uint_gt(count_inverted(&c), 0);
        ck_assert_int_eq(repair(NULL, NULL, &c), ICC_OK);
        ck_assert_uint_eq(count_inverted(&c), 0);
        size_t n_moved = 0;
        for (size_t v = 0; v < c.mesh->n_points; ++v)
            n_moved += memcmp(c.images + d * v, c.start + d * v, d * sizeof(double)) != 0;
        ck_assert(n_moved >= 1 && n_moved <= mesh_power(5, dim));
        free_cube(&c);
    }
}
END_TEST

/* Every triangle with a point that may move is in one patch, as it is in the map, and so is every
 * such point; what is put back moves these alone. */
START_TEST(patches_have_nothing_in_common)
{
    random_source r = {11};
    const iccp_env env = default_env();
    for (unsigned share = 2; share <= 40; share += 2) {
        cube c = cube_of(2, 12, 0.1, false, &r);
        const size_t n = c.mesh->n_points;
        const iccp_simplicial_map map = iccp_simplicial_map_of(c.mesh, c.images);
        uint8_t *movable = mesh_alloc(n, 1);
        size_t *seen = mesh_alloc(n, sizeof *seen), n_triangles = 0;
        iccp_patches patches;
        for (size_t v = 0; v < n; ++v) {
            movable[v] = random_unit(&r) * share < 3;
            seen[v] = 0;
        }
        ck_assert_int_eq(iccp_patches_create(&patches, &map, movable, &env.memory), ICC_OK);
        for (size_t p = 0; p < patches.n; ++p) {
            const iccp_simplicial_map part = iccp_patches_cut_out(&patches, p);
            n_triangles += part.n_simplices;
            for (size_t k = 0; k < 3 * part.n_simplices; ++k) {
                const size_t t = patches.triangle[patches.first[p] + k / 3];
                ck_assert_mem_eq(part.points + 2 * part.corners[k],
                                 map.points + 2 * map.corners[3 * t + k % 3], 2 * sizeof(double));
            }
            for (size_t v = 0; v < part.n_points; ++v) {
                const uint32_t point = patches.point[v];
                ck_assert(part.fixed[v] == (point < map.n_fixed || !movable[point]));
                seen[point] += !part.fixed[v];
                part.images[2 * v] += 1;
            }
            iccp_patches_put_back(&patches, &part);
        }
        for (size_t v = 0; v < n; ++v) {
            const size_t moves = movable[v] && v >= map.n_fixed;
            ck_assert_uint_eq(seen[v], moves);
            ck_assert_double_eq(c.images[2 * v], c.start[2 * v] + (double)moves);
        }
        size_t n_all = 0;
        for (size_t t = 0; t < map.n_simplices; ++t) {
            const uint32_t *v = map.corners + 3 * t;
            n_all += seen[v[0]] + seen[v[1]] + seen[v[2]] > 0;
        }
        ck_assert_uint_eq(n_triangles, n_all);
        ck_assert(share < 20 || patches.n > 1);
        iccp_patches_free(&patches);
        free(movable);
        free(seen);
        free_cube(&c);
    }
}
END_TEST

/* Inside out, and all of it or all but one vertex on the boundary. */
START_TEST(what_cannot_be_repaired_is_counted)
{
    random_source r = {6};
    const iccp_env env = default_env();
    for (int32_t dim = 2; dim <= 3; ++dim)
        for (size_t n = 1; n <= 2; ++n) {
            cube c = cube_of(dim, n, 0, false, &r);
            const size_t n_numbers = c.mesh->dim * c.mesh->n_points;
            size_t n_left = 0;
            for (size_t i = 0; i < n_numbers; i += c.mesh->dim)
                c.images[i] = -c.images[i];
            const iccp_simplicial_map map = iccp_simplicial_map_of(c.mesh, c.images);
            iccp_work work = iccp_work_unlimited();
            ck_assert_int_eq(iccp_untangle(&map, &work, &n_left, &env), ICC_OK);
            ck_assert_uint_ge(n_left, dim == 2 ? 2 * n : n == 1 ? 6 : 24);
            ck_assert_uint_eq(n_left, count_inverted(&c));
            for (size_t i = 0; i < n_numbers; ++i)
                ck_assert(isfinite(c.images[i]));
            free_cube(&c);
        }
}
END_TEST

/* A point without an image gets one, and a good map stays as it is. */
START_TEST(points_without_an_image)
{
    random_source r = {8};
    for (int32_t dim = 2; dim <= 3; ++dim) {
        cube c = cube_of(dim, 5, 0.1, true, &r);
        ck_assert_int_eq(repair(NULL, NULL, &c), ICC_OK);
        ck_assert_mem_eq(c.images, c.start, c.size);
        for (size_t i = c.mesh->dim * c.mesh->n_boundary; i < c.size / sizeof *c.start; ++i)
            c.start[i] = NAN;
        memcpy(c.images, c.start, c.size);
        iccp_simplicial_map map = iccp_simplicial_map_of(c.mesh, c.images);
        ck_assert_uint_gt(iccp_simplicial_count_inverted(&map), c.mesh->n_simplices / 20);
        ck_assert_int_eq(repair(NULL, NULL, &c), ICC_OK);
        ck_assert_uint_eq(iccp_simplicial_count_inverted(&map), 0);
        ck_assert_uint_eq(count_inverted(&c), 0);
        free_cube(&c);
    }
}
END_TEST

START_TEST(failures_leave_nothing_behind)
{
    random_source r = {7};
    for (int32_t dim = 2; dim <= 3; ++dim) {
        cube c = cube_of(dim, 3, 0.1, false, &r);
        tangle(&c, 2, &r);
        faulty_sweep(repair, &c);
        free_cube(&c);
    }
}
END_TEST

/* ---- Newton's method ---- */

/* Energy and slope against differences along the step. */
START_TEST(steps_go_down)
{
    random_source r = {9};
    const iccp_env env = default_env();
    for (int32_t dim = 2; dim <= 3; ++dim)
        for (int kind = ICCP_DIRICHLET; kind <= ICCP_UNTANGLE; ++kind) {
            cube c = cube_of(dim, 5, 0.1, true, &r);
            const iccp_simplicial_map map = iccp_simplicial_map_of(c.mesh, c.images);
            iccp_newton newton;
            double slope, energy[2];
            for (size_t v = 0; v < c.mesh->n_points; ++v)
                bend(c.mesh->dim, c.mesh->points + c.mesh->dim * v, c.images + c.mesh->dim * v);
            ck_assert_uint_eq(count_inverted(&c), 0);
            ck_assert_int_eq(iccp_newton_create(&newton, &map, NULL, NULL, &env), ICC_OK);
            ck_assert_uint_eq(newton.assembly.n_free, c.mesh->n_points - c.mesh->n_boundary);
            ck_assert_int_eq(iccp_newton_solve(&newton, (iccp_energy)kind, 0.1, &slope, &env),
                             ICC_OK);
            ck_assert_double_lt(slope, 0);
            for (int k = 0; k < 2; ++k) {
                for (size_t i = 0; i < map.dim * newton.assembly.n_free; ++i)
                    map.images[map.dim * newton.assembly.free_point[i / map.dim] + i % map.dim] +=
                        (k == 0 ? -1e-5 : 2e-5) * newton.step[i];
                energy[k] = iccp_newton_energy(&newton, (iccp_energy)kind, 0.1);
            }
            ck_assert_double_eq_tol((energy[1] - energy[0]) / 2e-5 / slope, 1, 1e-4);
            iccp_newton_free(&newton);
            free_cube(&c);
        }
}
END_TEST

/* Steps that use what earlier ones prepared have the same bits as steps that prepare it again. */
START_TEST(prepared_steps_are_the_same)
{
    random_source r = {10};
    const iccp_env env = default_env();
    for (int32_t dim = 2; dim <= 3; ++dim) {
        cube c = cube_of(dim, 5, 0, false, &r);
        double *images = malloc(c.size);
        ck_assert(images != NULL);
        for (size_t i = c.mesh->dim * c.mesh->n_boundary; i < c.size / sizeof *c.images; ++i)
            c.images[i] += random_between(&r, -0.02, 0.02);
        memcpy(images, c.images, c.size);
        const iccp_simplicial_map map = iccp_simplicial_map_of(c.mesh, c.images);
        const iccp_simplicial_map other = iccp_simplicial_map_of(c.mesh, images);
        iccp_newton newton = {.assembly.memory = env.memory};
        iccp_work work = iccp_work_unlimited();
        iccp_improvement improvement = {0};
        for (size_t majorised = 3; majorised-- > 0;) {
            const iccp_descent descent = {majorised, 2, 0, 0, false};
            const double *element = newton.element;
            ck_assert_int_eq(
                iccp_improve_images(&map, &descent, &newton, &work, &improvement, &env), ICC_OK);
            ck_assert(element == NULL || newton.element == element);
            ck_assert_int_eq(iccp_take_steps(&other, &descent, &work, NULL, &env), ICC_OK);
            ck_assert_mem_eq(c.images, images, c.size);
        }
        iccp_newton_free(&newton);
        free(images);
        free_cube(&c);
    }
}
END_TEST

/* A cube as it was with its inner vertices shaken: the fairest map with this boundary is the
 * identity, and every step towards it keeps all simplices positive. */
START_TEST(shaken_maps_become_fair)
{
    random_source r = {10};
    const iccp_env env = default_env();
    for (int32_t dim = 2; dim <= 3; ++dim)
        for (size_t steps = 0; steps <= 40; steps = 2 * steps + 5) {
            iccp_improvement improvement = {0};
            cube c = cube_of(dim, 5, 0, false, &r);
            const iccp_simplicial_map map = iccp_simplicial_map_of(c.mesh, c.images);
            for (size_t i = c.mesh->dim * c.mesh->n_boundary; i < c.size / sizeof *c.images; ++i)
                c.images[i] += random_between(&r, -0.02, 0.02);
            const double before = iccp_simplicial_energy(&map);
            const iccp_descent descent = {3, steps, 1e-13, 0, false};
            iccp_work work = iccp_work_unlimited();
            iccp_newton newton = {.assembly.memory = env.memory};
            ck_assert_int_eq(
                iccp_improve_images(&map, &descent, &newton, &work, &improvement, &env), ICC_OK);
            iccp_newton_free(&newton);
            const double after = iccp_simplicial_energy(&map);
            ck_assert_uint_le(improvement.n_iterations, steps);
            ck_assert_uint_eq(count_inverted(&c), 0);
            ck_assert_mem_eq(c.images, c.start, c.mesh->dim * c.mesh->n_boundary * sizeof(double));
            ck_assert(steps == 0 ? after >= before : after < before);
            if (steps >= 15) {
                ck_assert_double_eq_tol(after, 2 * dim, 1e-9);
                for (size_t i = 0; i < c.size / sizeof *c.images; ++i)
                    ck_assert_double_eq_tol(c.images[i], c.start[i], 1e-4);
            }
            free_cube(&c);
        }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("untangle");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, tangles);
    tcase_add_test(tests, what_is_far_away_stays);
    tcase_add_test(tests, patches_have_nothing_in_common);
    tcase_add_test(tests, what_cannot_be_repaired_is_counted);
    tcase_add_test(tests, points_without_an_image);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, steps_go_down);
    tcase_add_test(tests, prepared_steps_are_the_same);
    tcase_add_test(tests, shaken_maps_become_fair);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
