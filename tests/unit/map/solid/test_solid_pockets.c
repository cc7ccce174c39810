/* Necks and pockets: what is cut where all corners are fixed, and pockets of a map in which something
 * is inverted. */
#include "../../../faulty.h"
#include "../../../meshes.h"
#include "../../../suite.h"
#include "base/error.h"
#include "domain/domain.h"
#include "geometry/simplices.h"
#include "map/energy/mesh_repair.h"
#include "map/solid/solid_chords.h"
#include "map/solid/solid_pockets.h"
#include "math/predicates.h"

/* A bar has 2 x 2 x 8 cells. */
enum { LENGTH = 8, WIDTH = 2 };

static int is_bar(int32_t dim, const size_t *cell)
{
    (void)dim;
    return cell[0] < WIDTH && cell[1] < WIDTH;
}

/* ---- bodies that the bar becomes ---- */

typedef void (*body)(int32_t dim, const double *x, double *y);

static void arch(int32_t dim, const double *x, double *y)
{
    const double angle = 0.6 * x[2], radius = 1 + 0.4 * x[0];
    (void)dim;
    y[0] = radius * cos(angle);
    y[1] = 0.4 * x[1];
    y[2] = radius * sin(angle);
}

static void ball(int32_t dim, const double *x, double *y)
{
    double most = 0, square = 0;
    (void)dim;
    for (int k = 0; k < 3; ++k) {
        y[k] = x[k] / (k < 2 ? 1 : 4) - 1;
        most = fmax(most, fabs(y[k]));
        square += y[k] * y[k];
    }
    for (int k = 0; k < 3 && square > 0; ++k)
        y[k] *= most / sqrt(square);
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
    const iccp_solid_marks marks = {.n_fixed = p.source->n_vertices,
                                    .n_facets = p.source->n_facets,
                                    .facets = p.source->facets};
    ck_assert_int_eq(iccp_solid_cut_chords(&p.mesh, p.source->mesh, &marks, &env), ICC_OK);
    ck_assert_ptr_nonnull(p.mesh);
    ck_assert_int_eq(iccp_simplices_join(p.mesh, marks.n_facets, marks.facets, NULL), ICC_OK);
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

static size_t count_positive(const iccp_simplices *mesh, const double *x)
{
    size_t n = 0;
    for (size_t t = 0; t < mesh->n_simplices; ++t) {
        const uint32_t *v = mesh->corners + 4 * t;
        n += iccp_orient3d(x + 3 * v[0], x + 3 * v[1], x + 3 * v[2], x + 3 * v[3]) > 0;
    }
    return n;
}

/* Maps a mesh by moving images inside. Both results are NULL if that is in vain. */
static icc_status repair(iccp_simplices **mesh, double **images, const iccp_simplices *from,
                         const double *boundary, const iccp_env *env)
{
    const size_t n = 3 * from->n_points, n_given = 3 * from->n_boundary;
    icc_status status = iccp_simplices_copy(mesh, from, &env->memory);
    double *x = *images = iccp_alloc(&env->memory, n, sizeof *x);
    if (status == ICC_OK && x == NULL)
        status = ICC_ERR_MEMORY;
    for (size_t i = 0; status == ICC_OK && i < n; ++i)
        x[i] = i < n_given ? boundary[i] : NAN;
    if (status == ICC_OK)
        status = iccp_mesh_repair(*mesh, x, HUGE_VAL, env);
    if (status == ICC_OK)
        iccp_mesh_round(*mesh, x);
    if (status == ICC_OK && count_positive(*mesh, x) == from->n_simplices)
        return ICC_OK;
    iccp_free(&env->memory, x);
    iccp_simplices_free(*mesh);
    *mesh = NULL;
    *images = NULL;
    return status;
}

/* Of a problem; what is the result is freed. */
static void check_result(const problem *p, const double *boundary, iccp_simplices *mesh,
                         double *images)
{
    const size_t size = 3 * p->source->n_vertices * sizeof *images;
    ck_assert_uint_eq(mesh->n_boundary, p->source->n_vertices);
    ck_assert_mem_eq(mesh->points, p->source->vertices, size);
    ck_assert_mem_eq(images, boundary, size);
    ck_assert_uint_eq(count_positive(mesh, mesh->points), mesh->n_simplices);
    ck_assert_uint_eq(count_positive(mesh, images), mesh->n_simplices);
    ck_assert_int_eq(iccp_simplices_join(mesh, p->source->n_facets, p->source->facets, NULL),
                     ICC_OK);
    ck_assert_int_eq(iccp_simplices_check_shape(mesh, NULL), ICC_OK);
    iccp_free(&mesh->memory, images);
    iccp_simplices_free(mesh);
}

/* ---- pockets ---- */

static iccp_solid_solve by_repair, in_vain, no_better;

static icc_status by_repair(iccp_simplices **mesh, double **images, const icc_domain *from,
                            const icc_domain *to, const iccp_env *env)
{
    return repair(mesh, images, from->mesh, to->vertices, env);
}

static icc_status in_vain(iccp_simplices **mesh, double **images, const icc_domain *from,
                          const icc_domain *to, const iccp_env *env)
{
    ck_assert_uint_eq(from->n_facets, to->n_facets);
    *mesh = NULL;
    *images = NULL;
    return iccp_progress(env, "repair", 0);
}

/* What should be positive and is not, as rounding may leave it. */
static icc_status no_better(iccp_simplices **mesh, double **images, const icc_domain *from,
                            const icc_domain *to, const iccp_env *env)
{
    const size_t n = from->mesh->n_points;
    ck_assert_uint_eq(from->n_facets, to->n_facets);
    ck_assert_int_eq(iccp_simplices_copy(mesh, from->mesh, &env->memory), ICC_OK);
    *images = iccp_alloc(&env->memory, n, 3 * sizeof **images);
    ck_assert_ptr_nonnull(*images);
    for (size_t v = 0; v < n; ++v)
        memcpy(*images + 3 * v, to->vertices, 3 * sizeof **images);
    return ICC_OK;
}

/* The identity, but for one point inside that is somewhere else. */
static iccp_solid_map spoilt_map(const problem *p)
{
    const iccp_memory *memory = &p->mesh->memory;
    const size_t n = p->mesh->n_points, v = (n + p->mesh->n_boundary) / 2;
    iccp_solid_map map = {.memory = *memory, .stretch = 1};
    ck_assert_int_eq(iccp_simplices_copy(&map.own, p->mesh, memory), ICC_OK);
    map.mesh = map.own;
    map.images = iccp_alloc(memory, n, 3 * sizeof *map.images);
    ck_assert_ptr_nonnull(map.images);
    memcpy(map.images, p->mesh->points, 3 * n * sizeof *map.images);
    memcpy(map.images + 3 * v, map.images, 3 * sizeof *map.images);
    ck_assert_uint_lt(count_positive(map.mesh, map.images), map.mesh->n_simplices);
    return map;
}

static void free_map(iccp_solid_map *map)
{
    iccp_free(&map->memory, map->images);
    iccp_simplices_free(map->own);
}

static icc_status mend_once(const icc_env *given, icc_error *err, void *argument)
{
    const problem *p = argument;
    iccp_env env;
    iccp_solid_map map = {.stretch = 1}, spoilt = spoilt_map(p);
    icc_status status = iccp_env_read(&env, given, err);
    map.memory = env.memory;
    if (status == ICC_OK)
        status = iccp_simplices_copy(&map.own, spoilt.mesh, &env.memory);
    map.mesh = map.own;
    map.images = iccp_alloc(&env.memory, p->mesh->n_points, 3 * sizeof *map.images);
    if (status == ICC_OK && map.images == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        memcpy(map.images, spoilt.images, 3 * p->mesh->n_points * sizeof *map.images);
        status = iccp_solid_mend_pockets(&map, p->source, by_repair, &env);
    }
    free_map(&spoilt);
    if (given == NULL) { /* memory lasts */
        iccp_free(&map.memory, map.own->across);
        map.own->across = NULL;
        check_result(p, p->source->vertices, map.own, map.images);
    } else {
        free_map(&map);
    }
    return iccp_fail(err, status, "not mended");
}

/* Two tetrahedra with a common face: three fixed points around it, and it is no facet. All other
 * faces are. It is cut into three, and no tetrahedron with fixed corners is left. */
START_TEST(necks_are_cut)
{
    double points[15] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0.25, 0.25, 1, 0.25, 0.25, -1};
    uint32_t corners[8] = {0, 2, 1, 3, 0, 1, 2, 4};
    static const uint32_t FACETS[18] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4};
    iccp_env env;
    iccp_simplices *cut;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    iccp_simplices mesh = {.memory = env.memory,
                           .dim = 3,
                           .n_points = 5,
                           .n_boundary = 5,
                           .n_simplices = 2,
                           .points = points,
                           .corners = corners};
    ck_assert_int_eq(iccp_simplices_orient(&mesh, NULL), ICC_OK);
    iccp_solid_marks marks = {.n_fixed = 5, .n_facets = 6, .facets = FACETS};
    ck_assert_int_eq(iccp_solid_cut_chords(&cut, &mesh, &marks, &env), ICC_OK);
    ck_assert_ptr_nonnull(cut);
    ck_assert_uint_eq(cut->n_points, 6);
    ck_assert_uint_eq(cut->n_simplices, 6);
    ck_assert_int_eq(iccp_simplices_join(cut, 6, FACETS, NULL), ICC_OK);
    ck_assert_int_eq(iccp_simplices_check_shape(cut, NULL), ICC_OK);
    iccp_simplices_free(cut);
    /* A marked face stays, so each of the tetrahedra beside it gets a point. */
    static const uint32_t ALL[21] = {0, 1, 3, 1, 2, 3, 2, 0, 3, 1, 0, 4, 2, 1, 4, 0, 2, 4, 0, 1, 2};
    marks = (iccp_solid_marks){.n_fixed = 5, .n_facets = 7, .facets = ALL};
    ck_assert_int_eq(iccp_solid_cut_chords(&cut, &mesh, &marks, &env), ICC_OK);
    ck_assert_ptr_nonnull(cut);
    ck_assert_uint_eq(cut->n_points, 7);
    ck_assert_uint_eq(cut->n_simplices, 8);
    iccp_simplices_free(cut);
}
END_TEST

START_TEST(pockets)
{
    problem p = problem_of(arch, ball);
    icc_error err = {.size = sizeof err};
    ck_assert_msg(mend_once(NULL, &err, &p) == ICC_OK, "%s", err.message);
    faulty_sweep(mend_once, &p);
    free_problem(&p);
}
END_TEST

/* What nothing better comes in place of stays as it is. */
START_TEST(pockets_in_vain)
{
    static iccp_solid_solve *const SOLVES[] = {in_vain, no_better};
    problem p = problem_of(arch, ball);
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    for (size_t k = 0; k < 2; ++k) {
        iccp_solid_map map = spoilt_map(&p);
        const iccp_simplices *mesh = map.mesh;
        const size_t n_positive = count_positive(mesh, map.images);
        ck_assert_int_eq(iccp_solid_mend_pockets(&map, p.source, SOLVES[k], &env), ICC_OK);
        ck_assert_ptr_eq(map.mesh, mesh);
        ck_assert_uint_eq(count_positive(map.mesh, map.images), n_positive);
        free_map(&map);
    }
    free_problem(&p);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("necks and pockets");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, necks_are_cut);
    tcase_add_test(tests, pockets);
    tcase_add_test(tests, pockets_in_vain);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
