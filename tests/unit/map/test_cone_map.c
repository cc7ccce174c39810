/* A mesh in space onto a star-shaped target: every tetrahedron exactly positive on both sides, the
 * boundary as it was given, and what is told when there is no such map. */
#include "../../faulty.h"
#include "../../meshes.h"
#include "base/error.h"
#include "domain/domain.h"
#include "domain/simplices.h"
#include "map/cone_map.h"
#include "map/solid_chords.h"
#include "math/predicates.h"

/* A bar has 2 x 2 x 8 cells. */
enum { LENGTH = 8, WIDTH = 2 };

static int is_bar(int32_t dim, const size_t *cell)
{
    (void)dim;
    return cell[0] < WIDTH && cell[1] < WIDTH;
}

/* ---- bodies that the bar becomes: no point inside an arch sees both its ends ---- */

typedef void (*body)(int32_t dim, const double *x, double *y);

static void arch(int32_t dim, const double *x, double *y)
{
    const double angle = 0.6 * x[2], radius = 1 + 0.4 * x[0];
    (void)dim;
    y[0] = radius * cos(angle);
    y[1] = 0.4 * x[1];
    y[2] = radius * sin(angle);
}

static void cube(int32_t dim, const double *x, double *y)
{
    (void)dim;
    y[0] = x[0] - 1;
    y[1] = x[1] - 1;
    y[2] = x[2] / 4 - 1;
}

static void ball(int32_t dim, const double *x, double *y)
{
    double most = 0, square = 0;
    cube(dim, x, y);
    for (int k = 0; k < 3; ++k) {
        most = fmax(most, fabs(y[k]));
        square += y[k] * y[k];
    }
    for (int k = 0; k < 3 && square > 0; ++k)
        y[k] *= most / sqrt(square);
}

/* Bent in and out: radii of a ball between 0.05 and 1. */
static void star(int32_t dim, const double *x, double *y)
{
    random_source r = {(uint64_t)(x[0] + 10 * x[1] + 100 * x[2])};
    const double radius = random_between(&r, 0.05, 1);
    ball(dim, x, y);
    for (int k = 0; k < 3; ++k)
        y[k] *= radius;
}

/* A mesh of a body, without chords, and where its boundary goes. */
typedef struct problem {
    icc_domain *source;
    iccp_simplices *mesh;
    double *boundary;
} problem;

static problem problem_of(body source, body target)
{
    problem p;
    icc_error err = {.size = sizeof err};
    iccp_env env;
    test_mesh bar = mesh_cells(3, LENGTH, is_bar), bent = mesh_moved(&bar, source);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_msg(mesh_domain(&p.source, &bent, NULL, &err) == ICC_OK, "%s", err.message);
    ck_assert_int_eq(iccp_solid_cut_chords(&p.mesh, p.source, &env), ICC_OK);
    ck_assert_ptr_nonnull(p.mesh);
    p.boundary = mesh_alloc(3 * p.mesh->n_boundary, sizeof *p.boundary);
    for (size_t v = 0; v < p.mesh->n_boundary; ++v)
        target(3, bar.vertices + 3 * p.source->mesh->given[v], p.boundary + 3 * v);
    mesh_free(&bar);
    mesh_free(&bent);
    return p;
}

static void free_problem(problem *p)
{
    iccp_simplices_free(p->mesh);
    icc_domain_free(p->source);
    free(p->boundary);
}

static icc_status unfold(const problem *p, iccp_simplices **mesh, double **images,
                         const icc_env *given, icc_error *err)
{
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, given, err), ICC_OK);
    return iccp_cone_map(mesh, images, p->mesh, p->boundary, &env);
}

static size_t count_positive(const iccp_simplices *mesh, const double *x)
{
    size_t n = 0;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        const uint32_t *v = mesh->corners + 4 * t;
        n += iccp_orient3d(x + 3 * v[0], x + 3 * v[1], x + 3 * v[2], x + 3 * v[3]) > 0;
    }
    return n;
}

/* `grows`: whether it takes new points. */
static void check_map(body source, body target, bool grows)
{
    problem p = problem_of(source, target);
    iccp_simplices *mesh;
    double *images;
    ck_assert_int_eq(unfold(&p, &mesh, &images, NULL, NULL), ICC_OK);
    ck_assert_ptr_nonnull(mesh);
    const size_t size = 3 * p.source->n_vertices * sizeof *images;
    ck_assert_uint_eq(mesh->n_boundary, p.source->n_vertices);
    ck_assert_mem_eq(mesh->points, p.source->vertices, size);
    ck_assert_mem_eq(images, p.boundary, size);
    ck_assert(grows == (mesh->n_simplices > p.mesh->n_simplices));
    ck_assert_uint_eq(count_positive(mesh, mesh->points), mesh->n_simplices);
    ck_assert_uint_eq(count_positive(mesh, images), mesh->n_simplices);
    ck_assert_int_eq(iccp_simplices_join(mesh, p.source->n_facets, p.source->facets, NULL), ICC_OK);
    ck_assert_int_eq(iccp_simplices_check_shape(mesh, NULL), ICC_OK);
    iccp_free(&mesh->memory, images);
    iccp_simplices_free(mesh);
    free_problem(&p);
}

START_TEST(arch_onto_ball)
{
    check_map(arch, ball, false);
}
END_TEST

START_TEST(arch_onto_cube)
{
    check_map(arch, cube, false);
}
END_TEST

START_TEST(arch_onto_star)
{
    check_map(arch, star, true);
}
END_TEST

START_TEST(none_onto_arch)
{
    problem p = problem_of(ball, arch);
    iccp_simplices *mesh;
    double *images;
    ck_assert_int_eq(unfold(&p, &mesh, &images, NULL, NULL), ICC_OK);
    ck_assert_ptr_null(mesh);
    ck_assert_ptr_null(images);
    free_problem(&p);
}
END_TEST

static icc_status unfold_once(const icc_env *given, icc_error *err, void *argument)
{
    iccp_simplices *mesh;
    double *images;
    const icc_status status = unfold(argument, &mesh, &images, given, err);
    ck_assert((status == ICC_OK) == (mesh != NULL) && (status == ICC_OK) == (images != NULL));
    if (mesh != NULL)
        iccp_free(&mesh->memory, images);
    iccp_simplices_free(mesh);
    return iccp_fail(err, status, "no map");
}

START_TEST(failures)
{
    problem p = problem_of(arch, star);
    faulty_sweep(unfold_once, &p);
    free_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("cone map");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, arch_onto_ball);
    tcase_add_test(tests, arch_onto_cube);
    tcase_add_test(tests, arch_onto_star);
    tcase_add_test(tests, none_onto_arch);
    tcase_add_test(tests, failures);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
