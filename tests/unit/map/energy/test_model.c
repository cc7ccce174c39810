/* Newton's steps near a model: their derivatives, and where they end. */
#include "map/energy/descent.h"
#include "map/energy/newton.h"

#include "../../../plmaps.h"
#include "../../../suite.h"

enum { CELLS = 12 };
static const double PULL = 100;

/* The gradient that is summed is that of the energy, with a model that folds, too. */
START_TEST(gradient_is_that_of_the_energy)
{
    const iccp_env env = default_env();
    const double step = 1e-6;
    const shape square = shape_channel(1);
    iccp_plmap pl = map_of(&square, CELLS, wave, 1.1);
    double *model = calloc(pl.n_vertices, 2 * sizeof *model), slope;
    ck_assert_ptr_nonnull(model);
    for (size_t i = 0; i < 2 * pl.n_vertices; ++i)
        model[i] = (i % 3 == 0 ? -1 : 1) * pl.images[i];
    iccp_simplicial_map map = iccp_plmap_simplicial(&pl);
    map.model = model;
    map.pull = PULL;
    iccp_newton newton;
    ck_assert_int_eq(iccp_newton_create(&newton, &map, NULL, NULL, &env), ICC_OK);
    ck_assert_int_eq(iccp_newton_solve(&newton, ICCP_DIRICHLET, 0, &slope, &env), ICC_OK);
    for (size_t i = 0; i < newton.assembly.n_free; ++i) {
        double *x = pl.images + 2 * newton.assembly.free_point[i];
        const double before = *x, own = newton.assembly.gradient[2 * i];
        *x = before + step;
        const double high = iccp_newton_energy(&newton, ICCP_DIRICHLET, 0);
        *x = before - step;
        const double low = iccp_newton_energy(&newton, ICCP_DIRICHLET, 0);
        *x = before;
        ck_assert_double_eq_tol((high - low) / (2 * step), own, 1e-4 * (1 + fabs(own)));
    }
    iccp_newton_free(&newton);
    free(model);
    iccp_plmap_free(&pl);
}
END_TEST

/* Without a pull the steps go to the least Dirichlet energy. The stronger the pull, the nearer they
 * end to the model. */
START_TEST(pull_leads_to_the_model)
{
    const iccp_env env = default_env();
    const iccp_descent descent = {0, 50, 1e-12, 0, false};
    double before = HUGE_VAL;
    for (double pull = 1; pull < 1e7; pull *= 100) {
        const shape square = shape_channel(1);
        iccp_plmap pl = map_of(&square, CELLS, wave, 1.1);
        double *model = malloc(2 * pl.n_vertices * sizeof *model), distance = 0;
        ck_assert_ptr_nonnull(model);
        memcpy(model, pl.images, 2 * pl.n_vertices * sizeof *model);
        shake(&pl, 1, 0.02);
        iccp_simplicial_map map = iccp_plmap_simplicial(&pl);
        map.model = model;
        map.pull = pull;
        iccp_work work = iccp_work_unlimited();
        ck_assert_int_eq(iccp_take_steps(&map, &descent, &work, NULL, &env), ICC_OK);
        for (size_t i = 0; i < 2 * pl.n_vertices; ++i)
            distance = fmax(distance, fabs(pl.images[i] - model[i]));
        ck_assert_double_lt(distance, pull > 1e5 ? 1e-5 : before);
        ck_assert_uint_eq(iccp_plmap_count_inverted(&pl), 0);
        before = distance;
        free(model);
        iccp_plmap_free(&pl);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("near a model");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, gradient_is_that_of_the_energy);
    tcase_add_test(tests, pull_leads_to_the_model);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
