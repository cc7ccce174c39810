/* Splines through control points that make them fold become one-to-one. */
#include "fit/spline/spline.h"
#include "map/nearest/nearest.h"

#include "../default_env.h"
#include "../folding_points.h"
#include "../share.h"
#include "../suite.h"

#include <icc/fit.h>

enum { EACH = 50 };

static iccp_spline_task task_of(const folding_points *f)
{
    static const double LOWER[2] = {0, 0}, UPPER[2] = {1, 1};
    return (iccp_spline_task){.n = f->n,
                              .points = f->points,
                              .targets = f->targets,
                              .lower = LOWER,
                              .upper = UPPER,
                              .smoothing = -1};
}

static icc_status repair(iccp_spline *s, iccp_nearest_facts *facts, const iccp_env *env,
                         icc_error *err)
{
    for (uint32_t v = 0; v < s->map.n_vertices; ++v) {
        s->map.facet[v] = v;
        s->map.along[v] = 0;
    }
    return iccp_nearest(&s->map, true, facts, env, err);
}

/* The points have their targets exactly, and the mesh is sound. */
static void check_spline(const iccp_spline *s, const folding_points *f)
{
    const iccp_corners *c = &s->map.corners;
    ck_assert(iccp_plmap_is_positive(&s->map));
    for (size_t i = 0; i < f->n; ++i) {
        const size_t v = s->control.number[i];
        ck_assert_int_eq(memcmp(s->map.points + 2 * v, f->points + 2 * i, 2 * sizeof(double)), 0);
        ck_assert_int_eq(memcmp(s->map.images + 2 * v, f->targets + 2 * i, 2 * sizeof(double)), 0);
    }
    for (uint32_t k = 0; k < 3 * c->n_triangles; ++k)
        ck_assert(c->twin[k] == ICCP_NO_NEIGHBOUR || c->twin[c->twin[k]] == k);
}

/* At least 99 % of the problems that fold must become one-to-one. */
START_TEST(folds_are_repaired)
{
    int n_folded = 0, n_failed = 0, n_whole = 0;
    const iccp_env env = default_env();
    for (int kind = 0; kind < N_FOLD_KINDS; ++kind)
        for (int k = 0; k < share_of(EACH); ++k) {
            const folding_points f = folding_points_of(kind, (uint64_t)k);
            iccp_spline s;
            iccp_nearest_facts facts = {0};
            icc_error err = {.size = sizeof err};
            const iccp_spline_task task = task_of(&f);
            ck_assert_int_eq(iccp_spline_create(&s, &task, &env, &err), ICC_OK);
            const icc_status status = repair(&s, &facts, &env, &err);
            ck_assert_msg(status == ICC_OK || status == ICC_ERR_CERTIFICATE, "kind %d, %d: %s",
                          kind, k, err.message);
            if (status == ICC_OK)
                check_spline(&s, &f);
            n_failed += status != ICC_OK;
            n_folded += facts.n_folded > 0;
            n_whole += facts.repair == ICC_REPAIR_WHOLE;
            iccp_spline_free(&s);
        }
    ck_assert_int_ge(n_folded, 2 * share_of(EACH));
    ck_assert_int_le(100 * n_failed, n_folded);
    ck_assert_int_le(2 * n_whole, n_folded);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("folding points");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, folds_are_repaired);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
