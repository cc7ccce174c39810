/* Finding points in meshes: each way of asking gives the same answer, and the grid is made when it
 * is first needed. */
#include "base/budget.h"
#include "mesh/finder.h"

#include "../../faulty.h"
#include "../../hard_shapes.h"
#include "../../suite.h"
#include "../../together.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>

typedef struct meshed {
    icc_domain *domain;
    iccp_planar mesh;
    iccp_env env;
} meshed;

static meshed mesh_shape(const shape *s, int32_t cells)
{
    meshed m;
    uint32_t pieces[SHAPE_MAX];
    ck_assert_int_eq(icc_domain_create(&m.domain, 2, s->n, s->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_env_read(&m.env, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces, m.domain, NULL, cells);
    ck_assert_int_eq(iccp_planar_create(&m.mesh, m.domain, pieces, cells, &m.env, NULL), ICC_OK);
    return m;
}

static void clear(meshed *m)
{
    iccp_planar_free(&m->mesh);
    icc_domain_free(m->domain);
}

/* In and around the mesh; vertices, points of edges, and what is no number among them. */
static void choose_point(const meshed *m, random_source *r, int i, double p[2])
{
    const double *points = m->mesh.points;
    const size_t a = (size_t)random_below(r, (int)m->mesh.n_vertices);
    const size_t t = (size_t)random_below(r, (int)m->mesh.n_triangles);
    const double share = i % 16 < 3 ? 0 : random_unit(r);
    for (size_t k = 0; k < 2; ++k) {
        const double u = points[2 * (size_t)m->mesh.triangles[3 * t] + k];
        const double v = points[2 * (size_t)m->mesh.triangles[3 * t + 1] + k];
        p[k] = random_between(r, m->domain->lower[k] - 0.1, m->domain->upper[k] + 0.1);
        if (i % 4 == 1)
            p[k] = u + share * (v - u);
        if (i % 16 == 2)
            p[k] = points[2 * a + k] + random_between(r, -1e-14, 1e-14);
    }
    if (i % 97 == 0)
        p[i % 2] = i % 3 == 0 ? NAN : i % 3 == 1 ? HUGE_VAL : -1e300;
}

static void same_found(const iccp_found *a, const iccp_found *b)
{
    ck_assert_uint_eq(a->triangle, b->triangle);
    for (int k = 0; k < 3 && a->triangle != ICCP_NO_NEIGHBOUR; ++k)
        ck_assert(a->bary[k] >= b->bary[k] && a->bary[k] <= b->bary[k]);
}

/* One at a time, many at a time, and by looking at every triangle. */
START_TEST(all_ways_find_the_same)
{
    enum { N = ICCP_FINDER_MANY };
    const shape s = shape_hard(_i);
    /* A large mesh has its memory fetched. */
    meshed m = mesh_shape(&s, _i % 3 == 0 ? 150 : 12);
    random_source r = {(uint64_t)_i};
    iccp_finder finder;
    static double points[2 * N];
    static iccp_found many[N];
    iccp_finder_init(&finder, &m.mesh, m.mesh.points, 0,
                     _i % 2 ? ICCP_MANY_POINTS : ICCP_FEW_POINTS, &m.env.memory);
    ck_assert_int_eq(iccp_finder_ready(&finder), ICC_OK);
    for (int round = 0; round < share_of(40); ++round) {
        const size_t n = round == 0 ? N : 1 + (size_t)random_below(&r, N);
        for (size_t i = 0; i < n; ++i)
            choose_point(&m, &r, (int)i, points + 2 * i);
        iccp_finder_find_many(&finder, n, points, m.mesh.points, many);
        for (size_t i = 0; i < n; ++i) {
            iccp_found one, alone;
            const icc_status status = iccp_finder_find(&finder, points + 2 * i, &one);
            ck_assert_int_eq(status,
                             many[i].triangle != ICCP_NO_NEIGHBOUR ? ICC_OK : ICC_ERR_TRACE);
            same_found(&one, &many[i]);
            ck_assert(one.is_near == many[i].is_near);
            if (i % 8 != 0 || i % 97 == 0)
                continue;
            ck_assert_int_eq(iccp_finder_find_alone(&finder, points + 2 * i, &alone), status);
            if (status == ICC_OK)
                same_found(&alone, &one);
        }
    }
    iccp_finder_free(&finder);
    clear(&m);
}
END_TEST

/* Points that are not near are far enough from the boundary, however wide the band. */
START_TEST(what_is_near_is_known)
{
    static const double REACHES[] = {0, 1e-14, 1e-6, 1e-3, 0.3};
    const shape s = shape_hard(_i);
    meshed m = mesh_shape(&s, 12);
    random_source r = {(uint64_t)_i};
    for (size_t k = 0; k < sizeof REACHES / sizeof *REACHES; ++k) {
        iccp_finder finder;
        size_t n_far = 0;
        iccp_finder_init(&finder, &m.mesh, m.mesh.points, REACHES[k], ICCP_FEW_POINTS,
                         &m.env.memory);
        for (int i = 0; i < share_of(4000); ++i) {
            double p[2];
            iccp_found found;
            choose_point(&m, &r, i, p);
            (void)iccp_finder_find(&finder, p, &found);
            n_far += !found.is_near;
            for (size_t e = 0; e < m.mesh.n_boundary && !found.is_near; ++e) {
                const double *a = m.mesh.points + 2 * e;
                const double *b = m.mesh.points + 2 * ((e + 1) % m.mesh.n_boundary);
                const double x = b[0] - a[0], y = b[1] - a[1], u = p[0] - a[0], v = p[1] - a[1];
                const double t = fmin(fmax((u * x + v * y) / (x * x + y * y), 0), 1);
                ck_assert_double_gt(hypot(u - t * x, v - t * y), 3 * REACHES[k]);
            }
        }
        /* Channels and splinters are near everywhere. */
        if (REACHES[k] < 1e-5 && _i != 7 && _i != 8 && test_share() == 100)
            ck_assert_uint_gt(n_far, 0);
        iccp_finder_free(&finder);
    }
    clear(&m);
}
END_TEST

START_TEST(a_grid_is_made_when_it_is_needed)
{
    const shape s = shape_l();
    meshed m = mesh_shape(&s, 12);
    iccp_finder finder;
    iccp_found found;
    faulty f = {0};
    iccp_env env;
    const icc_env given = faulty_env(&f);
    const double middle[2] = {0.125, 0.125};
    ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
    iccp_finder_init(&finder, &m.mesh, m.mesh.points, 0, ICCP_MANY_POINTS, &env.memory);
    ck_assert_int_eq(iccp_finder_find_alone(&finder, middle, &found), ICC_OK);
    ck_assert_uint_eq(f.n_allocs, 0);
    for (int k = 0; k < 3; ++k) {
        f.fail_at = f.n_allocs + 1 + (size_t)k;
        ck_assert_int_eq(k == 0 ? iccp_finder_ready(&finder)
                                : iccp_finder_find(&finder, middle, &found),
                         ICC_ERR_MEMORY);
        ck_assert_uint_eq(f.n_live, 0);
    }
    ck_assert_int_eq(iccp_finder_find(&finder, middle, &found), ICC_OK);
    ck_assert_uint_eq(f.n_live, 3);
    const size_t n_allocs = f.n_allocs;
    ck_assert_int_eq(iccp_finder_find(&finder, middle, &found), ICC_OK);
    ck_assert_uint_eq(f.n_allocs, n_allocs);
    iccp_finder_free(&finder);
    ck_assert_uint_eq(f.n_live, 0);
    clear(&m);
}
END_TEST

typedef struct asker {
    const iccp_finder *finder;
    const meshed *m;
    size_t n_wrong;
} asker;

static void *ask(void *argument)
{
    asker *a = argument;
    for (uint32_t v = 0; v < a->m->mesh.n_vertices; ++v) {
        iccp_found found;
        const double *p = a->m->mesh.points + 2 * (size_t)v;
        const icc_status status = iccp_finder_find(a->finder, p, &found);
        const uint32_t *corners = a->m->mesh.triangles + 3 * (size_t)found.triangle;
        a->n_wrong += status != ICC_OK || (corners[0] != v && corners[1] != v && corners[2] != v);
    }
    return NULL;
}

START_TEST(threads_may_ask_at_once)
{
    const shape s = shape_l();
    meshed m = mesh_shape(&s, 40);
    for (int round = 0; round < share_of(40); ++round) {
        iccp_finder finder;
        asker askers[TOGETHER];
        iccp_finder_init(&finder, &m.mesh, m.mesh.points, 0, ICCP_MANY_POINTS, &m.env.memory);
        for (int k = 0; k < TOGETHER; ++k)
            askers[k] = (asker){&finder, &m, 0};
        run_together(ask, askers, sizeof *askers);
        for (int k = 0; k < TOGETHER; ++k)
            ck_assert_uint_eq(askers[k].n_wrong, 0);
        iccp_finder_free(&finder);
    }
    clear(&m);
}
END_TEST

/* A fan of long thin triangles across all of the box. */
START_TEST(large_grids_need_a_budget)
{
    enum { N = 400 };
    static double points[2 * (N + 2)];
    static uint32_t triangles[3 * N], twins[3 * N];
    iccp_planar mesh = {.n_vertices = N + 2,
                        .n_triangles = N,
                        .points = points,
                        .triangles = triangles,
                        .twins = twins};
    for (uint32_t k = 0; k <= N; ++k) {
        points[2 + 2 * k] = 1;
        points[3 + 2 * k] = (double)k / N;
    }
    for (uint32_t k = 0; k < 3 * N; ++k) {
        triangles[k] = k % 3 == 0 ? 0 : k / 3 + k % 3;
        twins[k] = ICCP_NO_NEIGHBOUR;
    }
    iccp_finder finder;
    iccp_env env;
    iccp_budget budget;
    for (int k = 0; k < 2; ++k) {
        faulty f = {0};
        icc_env given = faulty_env(&f);
        given.load_limit = k == 0 ? 1000 : 1000000;
        ck_assert_int_eq(iccp_env_read(&env, &given, NULL), ICC_OK);
        iccp_finder_init(&finder, &mesh, points, 0, ICCP_MANY_POINTS, &env.memory);
        ck_assert_int_eq(iccp_finder_budget(&finder, &env), ICC_OK);
        const iccp_env limited = iccp_budget_begin(&budget, &env);
        ck_assert_int_eq(iccp_finder_budget(&finder, &limited),
                         k == 0 ? ICC_ERR_CANCELLED : ICC_OK);
        ck_assert_uint_eq(f.n_allocs, 0);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("finder");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_loop_test(tests, all_ways_find_the_same, 0, N_HARD_SHAPES);
    tcase_add_loop_test(tests, what_is_near_is_known, 0, N_HARD_SHAPES);
    tcase_add_test(tests, a_grid_is_made_when_it_is_needed);
    tcase_add_test(tests, threads_may_ask_at_once);
    tcase_add_test(tests, large_grids_need_a_budget);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
