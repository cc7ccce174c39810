/* The untangling energy of one tetrahedron, and meshes in a tangle. */
#include <check.h>
#include <stdbool.h>
#include <stdlib.h>

#include "../../faulty.h"
#include "../../meshes.h"
#include "domain/domain.h"
#include "domain/simplices.h"
#include "map/tet_distortion.h"
#include "map/tet_repair.h"
#include "math/predicates.h"

/* ---- energy ---- */

typedef struct sample {
    iccp_tet tet;
    double point[12], image[12];
} sample;

static void corners_of(const double *points, const double *corner[4])
{
    for (int k = 0; k < 4; ++k)
        corner[k] = points + 3 * k;
}

static double volume_of(const double *p)
{
    double e[3][3];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 3; ++k)
            e[i][k] = p[3 * (i + 1) + k] - p[k];
    return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
            e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
            e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
           6;
}

/* A tetrahedron that is not too flat, and any image. */
static sample random_sample(random_source *r)
{
    sample s;
    const double *corner[4];
    do {
        for (int i = 0; i < 12; ++i)
            s.point[i] = random_between(r, -1, 1);
    } while (!(volume_of(s.point) > 0.05));
    corners_of(s.point, corner);
    iccp_tet_create(&s.tet, corner);
    ck_assert_double_eq_tol(s.tet.volume, volume_of(s.point), 1e-15);
    for (int i = 0; i < 12; ++i)
        s.image[i] = random_between(r, -1, 1);
    return s;
}

static double energy_at(const sample *s, const double *image, double epsilon)
{
    const double *corner[4];
    corners_of(image, corner);
    return iccp_tet_untangle_energy(&s->tet, corner, epsilon);
}

static void local_at(const sample *s, double epsilon, iccp_tet_local *local)
{
    const double *corner[4];
    corners_of(s->image, corner);
    iccp_tet_untangle_local(&s->tet, corner, epsilon, local);
}

static void check_gradient(const sample *s, double epsilon, const iccp_tet_local *local)
{
    double scale = 1, worst = 0;
    for (int i = 0; i < 12; ++i)
        scale = fmax(scale, fabs(local->gradient[i]));
    for (int i = 0; i < 12; ++i) {
        const double h = 1e-6;
        double up[12], down[12];
        memcpy(up, s->image, sizeof up);
        memcpy(down, s->image, sizeof down);
        up[i] += h;
        down[i] -= h;
        const double slope = (energy_at(s, up, epsilon) - energy_at(s, down, epsilon)) / (2 * h);
        worst = fmax(worst, fabs(local->gradient[i] - slope));
    }
    ck_assert_double_le(worst, 1e-5 * scale);
}

static double quadratic(const iccp_tet_local *local, const double *d)
{
    double sum = 0;
    for (int r = 0; r < 12; ++r)
        for (int c = 0; c < 12; ++c)
            sum += d[r] * local->hessian[r][c] * d[c];
    return sum;
}

static double second_difference(const sample *s, const double *d, double epsilon)
{
    const double h = 1e-4;
    double up[12], down[12];
    for (int i = 0; i < 12; ++i) {
        up[i] = s->image[i] + h * d[i];
        down[i] = s->image[i] - h * d[i];
    }
    return (energy_at(s, up, epsilon) - 2 * energy_at(s, s->image, epsilon) +
            energy_at(s, down, epsilon)) /
           (h * h);
}

/* Symmetric, blind to translations, nowhere negative and at least the energy's curvature; the same as that
 * where `exact`. */
static void check_hessian(const sample *s, double epsilon, const iccp_tet_local *local, bool exact,
                          random_source *r)
{
    double scale = 0, skew = 0, rigid = 0;
    for (int i = 0; i < 12; ++i)
        scale += local->hessian[i][i];
    ck_assert(isfinite(scale));
    for (int i = 0; i < 12; ++i) {
        const double *row = local->hessian[i];
        for (int k = 0; k < 12; ++k)
            skew = fmax(skew, fabs(row[k] - local->hessian[k][i]));
        for (int axis = 0; axis < 3; ++axis)
            rigid = fmax(rigid, fabs(row[axis] + row[3 + axis] + row[6 + axis] + row[9 + axis]));
    }
    ck_assert_double_le(skew, 1e-12 * scale);
    ck_assert_double_le(rigid, 1e-12 * scale);
    for (int k = 0; k < 12; ++k) {
        double d[12];
        for (int i = 0; i < 12; ++i)
            d[i] = random_between(r, -1, 1);
        const double bound = quadratic(local, d), curvature = second_difference(s, d, epsilon);
        ck_assert_double_ge(bound, -1e-12 * scale);
        ck_assert_double_le(curvature - bound, 2e-3 * scale);
        ck_assert(!exact || fabs(curvature - bound) <= 1e-4 * scale);
    }
}

START_TEST(gradients_and_hessians)
{
    random_source r = {1};
    for (int k = 0; k < 4000; ++k) {
        const double epsilon = k % 2 ? 1 : 0.3;
        const sample s = random_sample(&r);
        iccp_tet_local local;
        local_at(&s, epsilon, &local);
        check_gradient(&s, epsilon, &local);
        check_hessian(&s, epsilon, &local, false, &r);
    }
}
END_TEST

/* There the energy is smallest, so nothing was left out. */
START_TEST(isometries)
{
    random_source r = {2};
    for (int k = 0; k < 500; ++k) {
        sample s = random_sample(&r);
        const double angle = random_between(&r, 0, 6), c = cos(angle), w = sin(angle);
        iccp_tet_local local;
        for (int i = 0; i < 4; ++i) {
            const double *p = s.point + 3 * i;
            const double image[3] = {c * p[1] - w * p[2] + 1, w * p[1] + c * p[2] - 2, p[0]};
            memcpy(s.image + 3 * i, image, sizeof image);
        }
        local_at(&s, 1e-9, &local);
        ck_assert_double_eq_tol(energy_at(&s, s.image, 1e-9), s.tet.volume, 1e-12);
        for (int i = 0; i < 12; ++i)
            ck_assert_double_eq_tol(local.gradient[i], 0, 1e-10);
        check_hessian(&s, 1e-9, &local, true, &r);
    }
}
END_TEST

/* Images in a plane, on a line, in a point; turned over; and as good as these. */
START_TEST(degenerate_images)
{
    random_source r = {3};
    for (int k = 0; k < 400; ++k) {
        sample s = random_sample(&r);
        const double flat[] = {0, 1e-8, 1e-16}, thin = flat[k % 3];
        iccp_tet_local local;
        for (int i = 0; i < 12; ++i)
            if (i % 3 < k / 3 % 4)
                s.image[i] = 0.3 + thin * s.image[i];
        local_at(&s, 0.1, &local);
        check_gradient(&s, 0.1, &local);
        check_hessian(&s, 0.1, &local, false, &r);
    }
}
END_TEST

/* ---- meshes ---- */

static icc_domain *domain_of(const test_mesh *m)
{
    icc_error err = {.size = sizeof err};
    icc_domain *domain;
    ck_assert_msg(mesh_domain(&domain, m, NULL, &err) == ICC_OK, "%s", err.message);
    return domain;
}

static size_t count_inverted(const iccp_simplices *mesh, const double *images)
{
    size_t n = 0;
    for (size_t s = 0; s < mesh->n_simplices; ++s) {
        const uint32_t *v = mesh->corners + 4 * s;
        n += iccp_orient3d(images + 3 * (size_t)v[0], images + 3 * (size_t)v[1],
                           images + 3 * (size_t)v[2], images + 3 * (size_t)v[3]) <= 0;
    }
    return n;
}

typedef struct tangle {
    const iccp_simplices *mesh;
    const double *start;
    double *images;
    size_t n_left;
} tangle;

static icc_status untangle(const icc_env *env, icc_error *err, void *argument)
{
    tangle *t = argument;
    iccp_env full;
    ck_assert_int_eq(iccp_env_read(&full, env, err), ICC_OK);
    memcpy(t->images, t->start, 3 * t->mesh->n_points * sizeof *t->images);
    const icc_status status = iccp_tet_repair(t->mesh, t->images, &t->n_left, &full);
    if (err != NULL) {
        err->status = status;
        err->message[0] = 'x';
    }
    return status;
}

/* A bend of the unit cube that leaves no simplex of a fine mesh flat. */
static void bend(const double *x, double *y)
{
    const double angle = 2 * (x[0] - 0.5), radius = 1 + x[1];
    y[0] = radius * sin(angle);
    y[1] = radius * cos(angle);
    y[2] = x[2] * (1 + 0.5 * x[0]);
}

/* Inner vertices anywhere: in a heap, at random, or where they were before the bend. */
static double *tangled(const iccp_simplices *mesh, int kind, random_source *r)
{
    double *images = mesh_alloc(3 * mesh->n_points, sizeof *images);
    for (size_t v = 0; v < mesh->n_points; ++v) {
        double *y = images + 3 * v;
        bend(mesh->points + 3 * v, y);
        for (int k = 0; k < 3 && v >= mesh->n_rim; ++k)
            y[k] = kind == 0   ? 0.5 + 1e-3 * random_unit(r)
                   : kind == 1 ? random_between(r, -1, 2)
                               : mesh->points[3 * v + (size_t)k];
    }
    return images;
}

START_TEST(tangles)
{
    random_source r = {4};
    for (size_t n = 4; n <= 7; ++n)
        for (int kind = 0; kind < 3; ++kind) {
            test_mesh m = mesh_cube(3, n, 0.1, &r);
            for (size_t i = 0; i < 3 * m.n_vertices; ++i)
                m.vertices[i] /= (double)n;
            icc_domain *d = domain_of(&m);
            const iccp_simplices *mesh = d->mesh;
            double *start = tangled(mesh, kind, &r);
            double *images = mesh_alloc(3 * mesh->n_points, sizeof *images);
            double *again = mesh_alloc(3 * mesh->n_points, sizeof *images);
            tangle t = {mesh, start, images, 1};
            ck_assert_uint_gt(count_inverted(mesh, start), mesh->n_simplices / 20);
            ck_assert_int_eq(untangle(NULL, NULL, &t), ICC_OK);
            ck_assert_uint_eq(t.n_left, count_inverted(mesh, images));
            if (t.n_left != 0)
                ck_abort_msg("n %zu, kind %d: %zu left of %zu", n, kind, t.n_left,
                             mesh->n_simplices);
            ck_assert_mem_eq(images, start, 3 * mesh->n_rim * sizeof *images);
            t.images = again;
            ck_assert_int_eq(untangle(NULL, NULL, &t), ICC_OK);
            ck_assert_mem_eq(images, again, 3 * mesh->n_points * sizeof *images);
            free(start);
            free(images);
            free(again);
            icc_domain_free(d);
            mesh_free(&m);
        }
}
END_TEST

/* Only what is in a tangle moves: a patch of two rings does here. */
START_TEST(what_is_far_away_stays)
{
    random_source r = {5};
    const size_t n = 10;
    test_mesh m = mesh_cube(3, n, 0, &r);
    icc_domain *d = domain_of(&m);
    const iccp_simplices *mesh = d->mesh;
    double *start = mesh_alloc(3 * mesh->n_points, sizeof *start);
    double *images = mesh_alloc(3 * mesh->n_points, sizeof *images);
    memcpy(start, mesh->points, 3 * mesh->n_points * sizeof *start);
    size_t moved = mesh->n_rim;
    while (fabs(start[3 * moved] - start[3 * moved + 1]) > 0 ||
           fabs(start[3 * moved] - start[3 * moved + 2]) > 0)
        ++moved;
    start[3 * moved] += 2.5 * start[3 * moved];
    tangle t = {mesh, start, images, 1};
    ck_assert_uint_gt(count_inverted(mesh, start), 0);
    ck_assert_int_eq(untangle(NULL, NULL, &t), ICC_OK);
    ck_assert_uint_eq(t.n_left, 0);
    size_t n_moved = 0;
    for (size_t v = 0; v < mesh->n_points; ++v)
        n_moved += memcmp(images + 3 * v, start + 3 * v, 3 * sizeof *images) != 0;
    ck_assert(n_moved >= 1 && n_moved <= 125);
    free(start);
    free(images);
    icc_domain_free(d);
    mesh_free(&m);
}
END_TEST

/* Inside out, and all of it or all but one vertex on the boundary. */
START_TEST(what_cannot_be_repaired_is_counted)
{
    random_source r = {6};
    for (size_t n = 1; n <= 2; ++n) {
        test_mesh m = mesh_cube(3, n, 0, &r);
        icc_domain *d = domain_of(&m);
        const iccp_simplices *mesh = d->mesh;
        double *start = mesh_alloc(3 * mesh->n_points, sizeof *start);
        double *images = mesh_alloc(3 * mesh->n_points, sizeof *images);
        for (size_t i = 0; i < 3 * mesh->n_points; ++i)
            start[i] = i % 3 == 0 ? -mesh->points[i] : mesh->points[i];
        tangle t = {mesh, start, images, 0};
        ck_assert_int_eq(untangle(NULL, NULL, &t), ICC_OK);
        ck_assert_uint_ge(t.n_left, n == 1 ? 6 : 24);
        ck_assert_uint_eq(t.n_left, count_inverted(mesh, images));
        for (size_t i = 0; i < 3 * mesh->n_points; ++i)
            ck_assert(isfinite(images[i]));
        free(start);
        free(images);
        icc_domain_free(d);
        mesh_free(&m);
    }
}
END_TEST

START_TEST(failures_leave_nothing_behind)
{
    random_source r = {7};
    test_mesh m = mesh_cube(3, 3, 0.1, &r);
    icc_domain *d = domain_of(&m);
    double *start = tangled(d->mesh, 2, &r);
    double *images = mesh_alloc(3 * d->mesh->n_points, sizeof *images);
    tangle t = {d->mesh, start, images, 0};
    faulty_sweep(untangle, &t);
    free(start);
    free(images);
    icc_domain_free(d);
    mesh_free(&m);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("untangle");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, gradients_and_hessians);
    tcase_add_test(tests, isometries);
    tcase_add_test(tests, degenerate_images);
    tcase_add_test(tests, tangles);
    tcase_add_test(tests, what_is_far_away_stays);
    tcase_add_test(tests, what_cannot_be_repaired_is_counted);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
