/* What the tests of the public functions cannot reach: corners of charts and maps. */
#include "chart/encode_points.h"
#include "foliation/chart_foliation.h"
#include "gradient/coordinates/gradient_line.h"
#include "map/map.h"
#include "method/chart_create.h"

#include "../../default_env.h"
#include "../../hard_shapes.h"
#include "../../shapes.h"
#include "../../suite.h"

#include <check.h>
#include <stdlib.h>

static icc_chart *chart_of(const shape *s, int32_t cells)
{
    const iccp_env env = default_env();
    const icc_chart_options options = {.method = ICC_METHOD_GRADIENT, .cells = cells};
    icc_domain *domain;
    icc_chart *chart;
    ck_assert_int_eq(iccp_domain_create(&domain, 2, s->n, s->xy, 0, NULL, &env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_chart_create(&chart, domain, &options, &env, NULL), ICC_OK);
    iccp_domain_release(domain);
    return chart;
}

START_TEST(zero_means_the_default)
{
    const shape s = shape_l();
    icc_chart *chart = chart_of(&s, 0);
    ck_assert_int_eq(chart->info.method, ICC_METHOD_GRADIENT);
    ck_assert_int_eq(chart->own.gradient.function, ICC_FUNCTION_DECAY);
    ck_assert_int_eq(chart->own.gradient.tree, ICC_TREE_THESIS);
    ck_assert_double_eq_tol(chart->info.spacing, 3.0 / 50, 1e-15);
    ck_assert_uint_eq(chart->own.gradient.n_unreachable + chart->own.gradient.n_cousin_violations,
                      0);
    ck_assert_uint_eq(chart->own.gradient.n_maxima, 1);
    ck_assert_uint_eq(chart->own.gradient.n_minima + chart->own.gradient.n_saddles, 0);
    ck_assert_uint_gt(chart->own.gradient.n_compression, 0);
    iccp_chart_release(chart);
}
END_TEST

START_TEST(a_chart_lives_as_long_as_someone_holds_it)
{
    const shape s = shape_square();
    icc_chart *chart = chart_of(&s, 5);
    ck_assert_ptr_eq(iccp_chart_retain(chart), chart);
    iccp_chart_release(chart);
    ck_assert_double_eq(chart->info.maximum[0], 0.5);
    iccp_chart_release(chart);
    iccp_chart_release(NULL);
    iccp_map_release(NULL);
}
END_TEST

static const icc_map_options ANY_KIND = {0};

START_TEST(methods_do_not_mix)
{
    const shape s = shape_square();
    const iccp_env env = default_env();
    icc_chart *a = chart_of(&s, 5), *b = chart_of(&s, 5);
    icc_map *map;
    icc_error err = {.size = sizeof err};
    b->info.method = 99;
    ck_assert_int_eq(iccp_map_create_from_charts(&map, a, b, &ANY_KIND, &env, &err),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(err.status, ICC_ERR_UNSUPPORTED);
    iccp_chart_release(a);
    iccp_chart_release(b);
}
END_TEST

START_TEST(dimensions_do_not_mix)
{
    const shape s = shape_square();
    const iccp_env env = default_env();
    icc_chart *a = chart_of(&s, 5), *b = chart_of(&s, 5);
    icc_map *map;
    icc_error err = {.size = sizeof err};
    b->domain->dim = 3;
    ck_assert_int_eq(iccp_map_create_from_charts(&map, a, b, &ANY_KIND, &env, &err),
                     ICC_ERR_BOUNDARY);
    ck_assert_int_eq(err.side, 2);
    b->domain->dim = 2;
    iccp_chart_release(a);
    iccp_chart_release(b);
}
END_TEST

typedef struct drawing {
    size_t n, stop_at;
    double last[2];
} drawing;

static icc_status draw(void *argument, const double *local)
{
    drawing *d = argument;
    if (d->n == d->stop_at)
        return ICC_ERR_MEMORY;
    ++d->n;
    memcpy(d->last, local, sizeof d->last);
    return ICC_OK;
}

/* From the boundary, from inside, and of the maximum itself. */
START_TEST(curves_are_drawn_from_anywhere)
{
    const shape s = shape_square();
    icc_chart *chart = chart_of(&s, 9);
    const double *maximum = chart->maximum;
    const double starts[3][2] = {{0.3, 0}, {0.3, 0.1}, {maximum[0], maximum[1]}};
    iccp_path path;
    iccp_path_init(&path, &chart->memory);
    for (int k = 0; k < 3; ++k) {
        drawing d = {.stop_at = SIZE_MAX};
        ck_assert_int_eq(iccp_chart_trace(chart, starts[k], &path, draw, &d), ICC_OK);
        ck_assert(k == 2 ? d.n == 1 : d.n > 5);
        ck_assert_mem_eq(d.last, maximum, sizeof d.last);
        /* Whoever draws may stop. */
        for (size_t m = 0; m < d.n; ++m) {
            drawing short_of = {.stop_at = m};
            ck_assert_int_eq(iccp_chart_trace(chart, starts[k], &path, draw, &short_of),
                             ICC_ERR_MEMORY);
            ck_assert_uint_eq(short_of.n, m);
        }
    }
    iccp_path_clear(&path);
    iccp_chart_release(chart);
}
END_TEST

/* The comb's back runs along a line of the grid; above it, outside, lie other teeth. Curves from
 * there must go down into the back. */
START_TEST(curves_from_a_grid_line_go_into_the_domain)
{
    const shape s = shape_comb(4);
    icc_chart *chart = chart_of(&s, 20);
    const iccp_gradient_state *state = chart->state;
    int n_on_line = 0;
    for (uint32_t facet = 5; facet <= 13; facet += 4)
        for (int i = 1; i < 20; ++i) {
            const double bary[2] = {1 - i / 20.0, i / 20.0};
            double p[2], lattice[2];
            iccp_domain_facet_point(chart->domain, facet, bary, p);
            iccp_gradient_to_lattice(state, p, lattice);
            n_on_line += lattice[1] <= floor(lattice[1]) && lattice[0] > floor(lattice[0]);
            iccp_walk2 walk;
            if (iccp_gradient_depart(chart->state, facet, p, &walk, NULL) == ICC_OK &&
                !walk.at_vertex)
                ck_assert(lattice[1] > floor(lattice[1]) || walk.v > 0);
        }
    ck_assert_int_gt(n_on_line, 20);
    iccp_chart_release(chart);
}
END_TEST

START_TEST(inward_is_inward)
{
    for (int k = 0; k < 2 * N_SHAPES; ++k) {
        shape s = shape_number(k / 2);
        if (k % 2)
            s = shape_reversed(&s);
        icc_chart *chart = chart_of(&s, 50);
        for (uint32_t facet = 0; facet < s.n; ++facet) {
            const double bary[2] = {0.5, 0.5};
            double p[2], inward[2];
            iccp_domain_facet_point(chart->domain, facet, bary, p);
            iccp_facet_inward(chart->domain, facet, inward);
            for (int side = -1; side <= 1; side += 2) {
                const double q[2] = {p[0] + side * 1e-6 * inward[0],
                                     p[1] + side * 1e-6 * inward[1]};
                ck_assert_int_eq(iccp_domain_locate(chart->domain, q, true, NULL, NULL),
                                 side > 0 ? ICC_INSIDE : ICC_OUTSIDE);
            }
        }
        iccp_chart_release(chart);
    }
}
END_TEST

/* A foliation of a dumbbell whose maximum lies in the corridor. */
static icc_chart *chart_of_corridor(const icc_domain *domain, int32_t cells)
{
    const iccp_env env = default_env();
    iccp_harmonic base = {0};
    icc_chart *chart;
    uint32_t pieces[12];
    const double middle[2] = {0.5 * (domain->lower[0] + domain->upper[0]),
                              0.5 * (domain->lower[1] + domain->upper[1])};
    iccp_planar_pieces(pieces, domain, NULL, cells);
    ck_assert_int_eq(iccp_harmonic_create(&base, domain, pieces, cells, &env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_harmonic_factorise(&base, &env, NULL), ICC_OK);
    const uint32_t centre = iccp_nearest_vertex(&base.mesh, base.mesh.points, middle);
    ck_assert_int_eq(iccp_chart_foliation_create(&chart, domain, &base, centre, &env, NULL),
                     ICC_OK);
    iccp_harmonic_free(&base);
    return chart;
}

/* All of the corridor counts as boundary; its maximum is the maximum, by every call. */
START_TEST(the_maximum_may_lie_on_the_boundary)
{
    for (int k = 0; k < 9; ++k) {
        const iccp_env env = default_env();
        const shape s = shape_dumbbell(ldexp(1, -46 - k / 3));
        icc_domain *domain;
        ck_assert_int_eq(iccp_domain_create(&domain, 2, s.n, s.xy, 0, NULL, &env, NULL), ICC_OK);
        icc_chart *chart = chart_of_corridor(domain, 10 + 7 * (k % 3));
        const double *maximum = chart->maximum;
        ck_assert_int_eq(iccp_domain_locate(domain, maximum, true, NULL, NULL), ICC_BOUNDARY);

        uint32_t facet;
        double bary[2], t, back[2];
        ck_assert_int_eq(
            icc_chart_encode(chart, 1, chart->info.maximum, &facet, bary, &t, NULL, NULL, NULL),
            ICC_OK);
        ck_assert_double_eq(t, 1);
        ck_assert_int_eq(icc_chart_decode(chart, 1, &facet, bary, &t, back, NULL, NULL, NULL),
                         ICC_OK);
        ck_assert_mem_eq(back, chart->info.maximum, sizeof back);

        iccp_coords coords;
        iccp_encode_jet jet;
        iccp_path path;
        drawing d = {.stop_at = SIZE_MAX};
        iccp_path_init(&path, &chart->memory);
        ck_assert_int_eq(iccp_encode_point(chart, chart->info.maximum, &coords, &jet),
                         ICC_ERR_TRACE);
        ck_assert_int_eq(iccp_chart_trace(chart, maximum, &path, draw, &d), ICC_OK);
        ck_assert_uint_eq(d.n, 1);
        iccp_path_clear(&path);
        iccp_chart_release(chart);
        iccp_domain_release(domain);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("chart");
    TCase *tests = tcase_create("all");
    tcase_add_test(tests, zero_means_the_default);
    tcase_add_test(tests, a_chart_lives_as_long_as_someone_holds_it);
    tcase_add_test(tests, methods_do_not_mix);
    tcase_add_test(tests, dimensions_do_not_mix);
    tcase_add_test(tests, curves_are_drawn_from_anywhere);
    tcase_add_test(tests, the_maximum_may_lie_on_the_boundary);
    tcase_add_test(tests, curves_from_a_grid_line_go_into_the_domain);
    tcase_add_test(tests, inward_is_inward);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
