/* Points inside a domain that are as dense as the samples of its boundary. */
#include "geometry/locate.h"
#include "mesh/grading.h"
#include "mesh/planar.h"

#include "../../faulty.h"
#include "../../hard_shapes.h"
#include "../../suite.h"

#include <check.h>
#include <stdbool.h>
#include <stdlib.h>

typedef struct graded {
    icc_domain *domain;
    size_t n_samples, n;
    double *samples, *length, *points, step;
} graded;

/* The corners of a shape, counter-clockwise, as samples. */
static graded corners_of(const shape *s, double cells)
{
    graded g = {.n_samples = s->n};
    ck_assert_int_eq(icc_domain_create(&g.domain, 2, s->n, s->xy, 0, NULL, NULL, NULL), ICC_OK);
    g.samples = malloc(2 * s->n * sizeof(double));
    g.length = malloc(s->n * sizeof(double));
    ck_assert(g.samples != NULL && g.length != NULL);
    memcpy(g.samples, g.domain->vertices, 2 * s->n * sizeof(double));
    for (size_t k = 0; k < s->n; ++k) {
        const double *p = g.samples + 2 * k, *q = g.samples + 2 * ((k + 1) % s->n);
        const double *o = g.samples + 2 * ((k + s->n - 1) % s->n);
        g.length[k] = fmax(hypot(q[0] - p[0], q[1] - p[1]), hypot(o[0] - p[0], o[1] - p[1]));
    }
    g.step =
        fmax(g.domain->upper[0] - g.domain->lower[0], g.domain->upper[1] - g.domain->lower[1]) /
        cells;
    return g;
}

static icc_status grade(graded *g, const iccp_env *env)
{
    const iccp_samples samples = {g->n_samples, g->samples, g->length};
    return iccp_graded_points(g->domain, &samples, g->step, &g->points, &g->n, env);
}

static graded graded_of(const shape *s, double cells)
{
    graded g = corners_of(s, cells);
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(grade(&g, &env), ICC_OK);
    return g;
}

static void graded_clear(graded *g)
{
    free(g->points);
    free(g->samples);
    free(g->length);
    icc_domain_free(g->domain);
}

/* The width that all samples allow at a point. */
static double allowed(const graded *g, const double *p)
{
    double width = g->step;
    for (size_t k = 0; k < g->n_samples; ++k)
        width = fmin(width,
                     g->length[k] + hypot(p[0] - g->samples[2 * k], p[1] - g->samples[2 * k + 1]));
    return width;
}

static double boundary_distance(const graded *g, const double *p)
{
    double t, distance2;
    (void)iccp_boxtree_nearest(&iccp_locator_trees(g->domain->locator)->edges, p, &t, &distance2);
    return sqrt(distance2);
}

typedef struct leaf {
    double centre[2], width;
    int level;
} leaf;

/* The leaf that holds a point: from the cells of the step's width, centred over the bounding box,
 * down until a cell is no wider than the samples allow at its centre. */
static leaf leaf_at(const graded *g, const double *p)
{
    leaf l = {.width = g->step};
    for (int d = 0; d < 2; ++d) {
        const double low = g->domain->lower[d], extent = g->domain->upper[d] - low;
        const double origin = low + 0.5 * (extent - ceil(extent / g->step) * g->step);
        l.centre[d] = origin + (floor((p[d] - origin) / g->step) + 0.5) * g->step;
    }
    for (; l.level < 12 && allowed(g, l.centre) < l.width; ++l.level) {
        l.width /= 2;
        for (int d = 0; d < 2; ++d)
            l.centre[d] += p[d] < l.centre[d] ? -l.width / 2 : l.width / 2;
    }
    return l;
}

static size_t find_point(const graded *g, const double *p)
{
    for (size_t k = 0; k < g->n; ++k)
        if (fabs(g->points[2 * k] - p[0]) + fabs(g->points[2 * k + 1] - p[1]) < 1e-12)
            return k;
    return g->n;
}

static bool is_wanted(const graded *g, const leaf *l)
{
    return iccp_domain_locate(g->domain, l->centre, true, NULL, NULL) == ICC_INSIDE &&
           boundary_distance(g, l->centre) > 0.45 * l->width;
}

/* Every point is the centre of its leaf, inside, clear of the boundary. */
static void check_points(const graded *g)
{
    size_t n_faults = 0;
    for (size_t k = 0; k < g->n; ++k) {
        const leaf l = leaf_at(g, g->points + 2 * k);
        n_faults += find_point(g, l.centre) != k || !is_wanted(g, &l);
    }
    ck_assert_uint_eq(n_faults, 0);
}

/* And every leaf has its point, unless that is too near the boundary. */
static void check_leaves(const graded *g, uint64_t seed)
{
    random_source r = {seed};
    size_t n_faults = 0, n_empty = 0;
    for (int k = 0; k < 1000; ++k) {
        const double p[2] = {random_between(&r, g->domain->lower[0], g->domain->upper[0]),
                             random_between(&r, g->domain->lower[1], g->domain->upper[1])};
        const leaf l = leaf_at(g, p);
        const bool wanted = is_wanted(g, &l);
        n_faults += wanted != (find_point(g, l.centre) < g->n);
        n_empty += !wanted;
    }
    ck_assert_uint_eq(n_faults, 0);
    ck_assert_uint_lt(n_empty, 1000);
}

START_TEST(points_are_the_leaves_centres)
{
    for (int k = 0; k < N_SHAPES - 1; ++k)
        for (int cells = 8; cells <= 32; cells *= 2) {
            const shape s = shape_number(k);
            graded g = graded_of(&s, cells);
            check_points(&g);
            check_leaves(&g, (uint64_t)k);
            ck_assert_uint_le(g.n, (size_t)cells * (size_t)cells * 16);
            graded_clear(&g);
        }
}
END_TEST

/* A square with one short edge: dense there only, sparse elsewhere, whatever the edge's length. */
START_TEST(points_follow_short_edges)
{
    for (double edge = 0.25; edge > 1e-3; edge /= 4) {
        const shape s = shape_of(5, (double[]){0, 0, .5, 0, .5 + edge, 0, 1, 1, 0, 1});
        graded g = corners_of(&s, 8);
        g.length[1] = g.length[2] = edge;
        iccp_env env;
        ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
        ck_assert_int_eq(grade(&g, &env), ICC_OK);
        check_points(&g);
        check_leaves(&g, 1);
        const double near[2] = {0.5 * (g.samples[2] + g.samples[4]), g.samples[3] + 1.5 * edge};
        ck_assert_double_le(leaf_at(&g, near).width, 2 * edge);
        /* Each halving of the length adds a few cells round the edge. */
        ck_assert(g.n > 20 && g.n < 300);
        graded_clear(&g);
    }
}
END_TEST

/* Cells are split at most twelve times. */
START_TEST(tiny_lengths_do_not_make_endless_trees)
{
    shape s = shape_square();
    size_t n[3];
    for (int k = 0; k < 3; ++k) {
        graded g = corners_of(&s, 8);
        g.length[2] = k == 0 ? 1e-5 : k == 1 ? 1e-13 : 0;
        iccp_env env;
        ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
        ck_assert_int_eq(grade(&g, &env), ICC_OK);
        n[k] = g.n;
        ck_assert_uint_le(g.n, 4000);
        graded_clear(&g);
    }
    ck_assert_uint_eq(n[1], n[2]);
    ck_assert_uint_ge(n[1], n[0]);
}
END_TEST

/* The hard shapes of the mesher too, with edges of 1e-13. */
START_TEST(hard_shapes_are_graded)
{
    for (int k = 0; k < N_HARD_SHAPES; ++k) {
        const shape s = shape_hard(k);
        graded g = graded_of(&s, 20);
        size_t n_outside = 0;
        for (size_t i = 0; i < g.n; ++i)
            n_outside +=
                iccp_domain_locate(g.domain, g.points + 2 * i, true, NULL, NULL) != ICC_INSIDE;
        ck_assert_uint_eq(n_outside, 0);
        ck_assert_uint_le(g.n, 60000);
        graded_clear(&g);
    }
    const shape tiny = shape_of(6, (double[]){0, 0, .5, 0, .5 + 1e-13, 0, 1, 0, 1, 1, 0, 1});
    graded g = graded_of(&tiny, 20);
    ck_assert(g.n > 200 && g.n < 2000);
    graded_clear(&g);
}
END_TEST

START_TEST(the_same_points_every_time)
{
    for (int k = 0; k < N_SHAPES; ++k) {
        const shape s = shape_number(k);
        graded g = graded_of(&s, 16), h = graded_of(&s, 16);
        ck_assert_uint_eq(g.n, h.n);
        if (g.n > 0)
            ck_assert_mem_eq(g.points, h.points, 2 * g.n * sizeof *g.points);
        graded_clear(&g);
        graded_clear(&h);
    }
}
END_TEST

static icc_status grade_l(const icc_env *env, icc_error *err, void *argument)
{
    graded *g = argument;
    iccp_env full;
    ck_assert_int_eq(iccp_env_read(&full, env, NULL), ICC_OK);
    const icc_status status = grade(g, &full);
    ck_assert(status == ICC_OK || (g->points == NULL && g->n == 0));
    iccp_free(&full.memory, g->points);
    g->points = NULL;
    if (status != ICC_OK && err != NULL) {
        err->status = status;
        err->message[0] = '.';
    }
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    const shape s = shape_star(5, 0.4, 0.1);
    graded g = corners_of(&s, 60);
    faulty_sweep(grade_l, &g);
    graded_clear(&g);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("grading");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 60);
    tcase_add_test(tests, points_are_the_leaves_centres);
    tcase_add_test(tests, points_follow_short_edges);
    tcase_add_test(tests, tiny_lengths_do_not_make_endless_trees);
    tcase_add_test(tests, hard_shapes_are_graded);
    tcase_add_test(tests, the_same_points_every_time);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
