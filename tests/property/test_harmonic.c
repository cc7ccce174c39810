/* Laplace's function with its zeros on the boundary itself. */
#include "../domains.h"
#include "../shapes.h"
#include "../suite.h"
#include "../surfaces.h"

#include <check.h>
#include <icc/stages.h>
#include <math.h>

/* Corners of a convex shape, anticlockwise. */
static const double QUAD[8] = {0, 0, 2, 0.3, 1.9, 1.7, -0.2, 1.2};

static icc_chart *chart_of(const icc_domain *domain, int32_t function, int32_t constraints,
                           int32_t cells)
{
    icc_chart *chart;
    const icc_chart_options options = {.size = sizeof options,
                                       .method = ICC_METHOD_GRADIENT,
                                       .function = function,
                                       .constraints = constraints,
                                       .cells = cells};
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    return chart;
}

static icc_chart_report report_of(const icc_chart *chart, size_t n)
{
    icc_chart_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_chart_get_report(chart, n, &report, NULL, NULL), ICC_OK);
    return report;
}

/* Where the ray from a point inside the quadrilateral leaves it. */
static double leave(const double *p, double x, double y)
{
    double least = HUGE_VAL;
    for (int i = 0; i < 4; ++i) {
        const double *a = QUAD + 2 * i, *b = QUAD + 2 * ((i + 1) % 4);
        const double nx = a[1] - b[1], ny = b[0] - a[0], rate = -(nx * x + ny * y);
        const double height = nx * (p[0] - a[0]) + ny * (p[1] - a[1]);
        if (rate > 0 && height / rate < least)
            least = height / rate;
    }
    return least;
}

/* Each value is the mean of its neighbours', weighted by one over the way to them, and that to the
 * boundary is taken where it comes first. */
START_TEST(solves_the_equation_of_cut_edges)
{
    icc_domain *domain = domain_of_polygon(4, QUAD);
    icc_chart *chart = chart_of(domain, ICC_FUNCTION_HARMONIC, ICC_CONSTRAINTS_NONE, 40);
    const icc_function *function = icc_chart_function(chart);
    const icc_tree *tree = icc_function_tree(function);
    const icc_grid *grid = icc_tree_grid(tree);
    const uint8_t *inside = icc_grid_inside(grid);
    const double *f = icc_function_values(function);
    icc_grid_info g = {.size = sizeof g};
    ck_assert_int_eq(icc_grid_get_info(grid, &g), ICC_OK);
    size_t n_cut = 0, n_beyond = 0;
    for (size_t v = 0; v < g.n_vertices; ++v) {
        if (!inside[v] || v == icc_tree_root(tree))
            continue;
        const double p[2] = {g.origin[0] + g.spacing * (double)(v % g.shape[0]),
                             g.origin[1] + g.spacing * (double)(v / g.shape[0])};
        const size_t near[4] = {v - 1, v + 1, v - g.shape[0], v + g.shape[0]};
        static const double TO[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
        double row = 0, size = 0;
        for (int d = 0; d < 4; ++d) {
            const double share =
                inside[near[d]] ? 1 : leave(p, TO[d][0] * g.spacing, TO[d][1] * g.spacing);
            row += (f[v] - (inside[near[d]] ? f[near[d]] : 0)) / share;
            size += f[v] / share;
            n_cut += share < 1;
            n_beyond += !inside[near[d]] && f[near[d]] < 0;
        }
        ck_assert_double_le(fabs(row), 1e-9 * size);
        ck_assert_double_gt(f[v], 0);
    }
    ck_assert_uint_gt(n_cut, 100);
    ck_assert_uint_gt(n_beyond, n_cut / 2);
    icc_chart_free(chart);
    icc_domain_free(domain);
}
END_TEST

START_TEST(satisfies_the_inequalities_where_they_are_imposed)
{
    const shape outline = shape_l();
    icc_domain *domain = domain_of_polygon(outline.n, outline.xy);
    icc_chart *chart = chart_of(domain, ICC_FUNCTION_HARMONIC, ICC_CONSTRAINTS_ALL, 60);
    const icc_function *function = icc_chart_function(chart);
    const uint32_t *parent = icc_tree_parents(icc_function_tree(function));
    const icc_grid *grid = icc_tree_grid(icc_function_tree(function));
    const double *f = icc_function_values(function);
    icc_grid_info g = {.size = sizeof g};
    icc_function_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &g), ICC_OK);
    ck_assert_int_eq(icc_function_get_info(function, &info), ICC_OK);
    for (size_t v = 0; v < g.n_vertices; ++v)
        ck_assert(!icc_grid_inside(grid)[v] || parent[v] == UINT32_MAX ||
                  f[v] * (1 + 1e-6) <= f[parent[v]]);
    ck_assert_uint_gt(info.n_active, 0);
    ck_assert_double_le(info.residual, 1e-9);
    icc_chart_free(chart);
    icc_domain_free(domain);
}
END_TEST

/* The boundary of a mask runs through vertices. */
START_TEST(is_laplace_on_a_mask)
{
    static const size_t SHAPE[2] = {3, 2};
    static const uint8_t CELLS[6] = {1, 1, 1, 1, 0, 0};
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create_mask(&domain, 2, SHAPE, CELLS, NULL, NULL), ICC_OK);
    icc_chart *a = chart_of(domain, ICC_FUNCTION_LAPLACE, 0, 24);
    icc_chart *b = chart_of(domain, ICC_FUNCTION_HARMONIC, 0, 24);
    icc_grid_info g = {.size = sizeof g};
    ck_assert_int_eq(icc_grid_get_info(icc_tree_grid(icc_function_tree(icc_chart_function(a))), &g),
                     ICC_OK);
    const double *f = icc_function_values(icc_chart_function(a));
    const double *h = icc_function_values(icc_chart_function(b));
    size_t n_compared = 0;
    for (size_t v = 0; v < g.n_vertices; ++v)
        if (!isnan(f[v])) {
            ck_assert_double_eq(f[v], h[v]);
            ++n_compared;
        }
    ck_assert_uint_gt(n_compared, 100);
    icc_chart_free(a);
    icc_chart_free(b);
    icc_domain_free(domain);
}
END_TEST

START_TEST(needs_a_boundary)
{
    static const size_t SHAPE[2] = {5, 5};
    uint8_t inside[25] = {0};
    for (int i = 0; i < 9; ++i)
        inside[6 + i % 3 + 5 * (i / 3)] = 1;
    icc_grid *grid;
    icc_tree *tree;
    icc_function *function = (icc_function *)&grid;
    const icc_function_options options = {.size = sizeof options,
                                          .function = ICC_FUNCTION_HARMONIC};
    ck_assert_int_eq(icc_grid_create_mask(&grid, 2, SHAPE, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, 12, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&function, tree, &options, NULL, NULL),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_null(function);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

/* Zeros on a staircase leave as much uncovered at any resolution, those on the boundary ever
 * less. */
START_TEST(less_is_uncovered_on_finer_grids)
{
    double xy[240], share[2][3];
    for (int i = 0; i < 120; ++i) {
        const double angle = 6.283185307179586 * i / 120;
        xy[2 * i] = 1.91 * cos(angle) - 0.296 * sin(angle);
        xy[2 * i + 1] = 0.592 * cos(angle) + 0.955 * sin(angle);
    }
    icc_domain *domain = domain_of_polygon(120, xy);
    for (int i = 0; i < 2; ++i)
        for (int k = 0; k < 3; ++k) {
            icc_chart *chart =
                chart_of(domain, i == 0 ? ICC_FUNCTION_LAPLACE : ICC_FUNCTION_HARMONIC,
                         ICC_CONSTRAINTS_NONE, 25 << k);
            const icc_chart_report report = report_of(chart, 20000);
            share[i][k] = report.uncovered;
            ck_assert_double_eq(report.unreachable, 0);
            ck_assert(i == 0 || report.not_inward <= 0);
            icc_chart_free(chart);
        }
    ck_assert_double_gt(share[0][2], share[0][0] / 2);
    ck_assert_double_lt(share[1][1], share[1][0]);
    ck_assert_double_lt(share[1][2], share[1][0] / 3);
    ck_assert_double_lt(share[1][2], share[0][2] / 10);
    icc_domain_free(domain);
}
END_TEST

/* Values fall through 1e-300, and those outside with them. */
START_TEST(reaches_the_end_of_a_long_limb)
{
    static const double LIMB[8] = {0, 0, 700, 3, 699.99, 4, -0.01, 1.1};
    icc_domain *domain = domain_of_polygon(4, LIMB);
    const double end[2] = {3, 0.5};
    icc_chart *chart;
    const icc_chart_options options = {.size = sizeof options,
                                       .method = ICC_METHOD_GRADIENT,
                                       .function = ICC_FUNCTION_HARMONIC,
                                       .cells = 5000,
                                       .maximum = end};
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    icc_function_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_function_get_info(icc_chart_function(chart), &info), ICC_OK);
    const icc_chart_report report = report_of(chart, 2000);
    ck_assert_double_lt(info.least_log, -1000);
    ck_assert_double_eq(report.unreachable, 0);
    ck_assert_double_le(report.not_inward, 0.02);
    icc_chart_free(chart);
    icc_domain_free(domain);
}
END_TEST

int main(void)
{
    TCase *tests = tcase_create("harmonic");
    tcase_add_test(tests, solves_the_equation_of_cut_edges);
    tcase_add_test(tests, satisfies_the_inequalities_where_they_are_imposed);
    tcase_add_test(tests, is_laplace_on_a_mask);
    tcase_add_test(tests, needs_a_boundary);
    tcase_add_test(tests, less_is_uncovered_on_finer_grids);
    tcase_add_test(tests, reaches_the_end_of_a_long_limb);
    Suite *suite = suite_create("harmonic");
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
