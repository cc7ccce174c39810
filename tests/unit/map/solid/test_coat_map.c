/* Which targets have an apex; a coat on a map onto a ball; pockets of a map in which something is
 * inverted. */
#include "../../../faulty.h"
#include "../../../meshes.h"
#include "../../../suite.h"
#include "base/error.h"
#include "domain/domain.h"
#include "geometry/simplices.h"
#include "map/energy/mesh_repair.h"
#include "map/solid/apex.h"
#include "map/solid/coat.h"
#include "map/solid/coat_map.h"
#include "map/solid/solid_chords.h"
#include "map/solid/solid_pockets.h"
#include "match/sphere/sphere.h"
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

static problem problem_of_cells(size_t length, int (*is_cell)(int32_t, const size_t *), body source,
                                body target)
{
    problem p;
    icc_error err = {.size = sizeof err};
    iccp_env env;
    test_mesh bar = mesh_cells(3, length, is_cell), bent = mesh_moved(&bar, source);
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_msg(mesh_domain(&p.source, &bent, NULL, &err) == ICC_OK, "%s", err.message);
    ck_assert_int_eq(iccp_solid_cut_chords(&p.mesh, p.source->mesh, p.source->facets, &env),
                     ICC_OK);
    ck_assert_ptr_nonnull(p.mesh);
    p.boundary = mesh_alloc(3 * p.mesh->n_boundary, sizeof *p.boundary);
    for (size_t v = 0; v < p.mesh->n_boundary; ++v)
        target(3, bar.vertices + 3 * p.source->mesh->given[v], p.boundary + 3 * v);
    mesh_free(&bar);
    mesh_free(&bent);
    return p;
}

static problem problem_of(body source, body target)
{
    return problem_of_cells(LENGTH, is_bar, source, target);
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

/* ---- the apex ---- */

static bool has_apex(body target)
{
    problem p = problem_of(arch, target);
    iccp_env env;
    bool sees;
    double apex[3];
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_find_apex(&sees, apex, p.mesh, p.boundary, &env.memory), ICC_OK);
    free_problem(&p);
    return sees;
}

START_TEST(apices)
{
    ck_assert(has_apex(ball));
    ck_assert(has_apex(cube));
    ck_assert(has_apex(star));
    ck_assert(!has_apex(arch));
}
END_TEST

/* ---- a coat on a map onto a ball ---- */

/* Four cells in a row with two corners, all at one vertex: its faces look up and down. */
static int is_chain(int32_t dim, const size_t *cell)
{
    (void)dim;
    return cell[0] >= cell[1] && cell[1] >= cell[2];
}

static void same(int32_t dim, const double *x, double *y)
{
    memcpy(y, x, (size_t)dim * sizeof *y);
}

/* The chain's mesh, with its drawing on the sphere, onto the ball; and that drawing on a cube. */
typedef struct dress {
    problem p;
    double *cube;
    iccp_simplices *mesh;
    double *images;
} dress;

static dress dress_of(void)
{
    dress d = {.p = problem_of_cells(2, is_chain, same, same)};
    iccp_env env;
    const icc_domain *domain = d.p.source;
    const size_t n = domain->n_vertices;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_sphere_draw(d.p.boundary, n, domain->vertices, domain->n_facets,
                                      domain->facets, &env, NULL),
                     ICC_OK);
    d.cube = mesh_alloc(3 * n, sizeof *d.cube);
    for (size_t v = 0; v < n; ++v) {
        const double *x = d.p.boundary + 3 * v;
        const double most = fmax(fabs(x[0]), fmax(fabs(x[1]), fabs(x[2])));
        for (int k = 0; k < 3; ++k)
            d.cube[3 * v + (size_t)k] = x[k] / most;
    }
    ck_assert_int_eq(repair(&d.mesh, &d.images, d.p.mesh, d.p.boundary, &env), ICC_OK);
    ck_assert_ptr_nonnull(d.mesh);
    return d;
}

static void free_dress(dress *d)
{
    iccp_free(&d->mesh->memory, d->images);
    iccp_simplices_free(d->mesh);
    free(d->cube);
    free_problem(&d->p);
}

/* Leaves the map onto the ball. */
static icc_status put_on(const dress *d, iccp_simplices **mesh, double **images,
                         const iccp_env *env)
{
    static const double apex[3] = {0, 0, 0};
    const size_t n = 3 * d->mesh->n_points;
    bool done = true;
    icc_status status = iccp_simplices_copy(mesh, d->mesh, &env->memory);
    *images = iccp_alloc(&env->memory, n, sizeof **images);
    if (status == ICC_OK && *images == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        memcpy(*images, d->images, n * sizeof **images);
        status = iccp_coat_put_on(mesh, images, d->cube, apex, &done, env);
    }
    ck_assert(done || status != ICC_OK);
    return status;
}

/* One vertex has no point below. */
START_TEST(coat)
{
    dress d = dress_of();
    iccp_simplices *mesh;
    double *images;
    iccp_coat c;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_coat_create(&c, d.mesh, &env.memory), ICC_OK);
    ck_assert_uint_eq(c.n_below, d.mesh->n_boundary - 1);
    ck_assert_uint_eq(c.core->n_simplices, d.mesh->n_simplices);
    ck_assert_uint_eq(count_positive(c.core, c.core->points), c.core->n_simplices);
    iccp_coat_free(&c);
    ck_assert_int_eq(put_on(&d, &mesh, &images, &env), ICC_OK);
    ck_assert_uint_gt(mesh->n_simplices, d.mesh->n_simplices);
    check_result(&d.p, d.cube, mesh, images);
    free_dress(&d);
}
END_TEST

static icc_status put_on_once(const icc_env *given, icc_error *err, void *argument)
{
    iccp_simplices *mesh;
    double *images;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, given, err), ICC_OK);
    const icc_status status = put_on(argument, &mesh, &images, &env);
    iccp_free(&env.memory, images);
    iccp_simplices_free(mesh);
    return iccp_fail(err, status, "no map");
}

START_TEST(coat_failures)
{
    dress d = dress_of();
    faulty_sweep(put_on_once, &d);
    free_dress(&d);
}
END_TEST

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
    Suite *suite = suite_create("coats and pockets");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, apices);
    tcase_add_test(tests, coat);
    tcase_add_test(tests, coat_failures);
    tcase_add_test(tests, pockets);
    tcase_add_test(tests, pockets_in_vain);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
