/* Bi-Laplace functions without inequalities are highest beside a root that is not in the middle:
 * charts move their maximum there, functions on a given tree say so. */
#include "../faulty.h"
#include "../infos.h"
#include "../random.h"
#include "../saved.h"
#include "../shape_domains.h"
#include "../shapes.h"
#include "../suite.h"
#include "../surfaces.h"

#include <check.h>
#include <icc/stages.h>
#include <stdio.h>
#include <stdlib.h>

enum { MOST_VERTICES = 4096 };

static icc_chart *make_chart(const icc_domain *domain, const icc_chart_options *options)
{
    icc_chart *chart;
    ck_assert_int_eq(icc_chart_create(&chart, domain, options, NULL, NULL), ICC_OK);
    return chart;
}

static icc_chart_options options_of(int32_t function, int32_t constraints, int32_t cells,
                                    const double *maximum)
{
    return (icc_chart_options){.size = sizeof(icc_chart_options),
                               .method = ICC_METHOD_GRADIENT,
                               .function = function,
                               .cells = cells,
                               .maximum = maximum,
                               .constraints = constraints};
}

static icc_gradient_info gradient_info_of(const icc_chart *chart)
{
    icc_gradient_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_chart_get_gradient_info(chart, &info), ICC_OK);
    return info;
}

/* The greatest value is at the root, and that is the maximum, as far from the place asked for as it
 * says. */
static void check_maximum(const icc_chart *chart, const double *asked)
{
    const icc_function *field = icc_chart_function(chart);
    const icc_tree *tree = icc_function_tree(field);
    const icc_grid *grid = icc_tree_grid(tree);
    const icc_chart_info info = info_of_chart(chart);
    icc_function_info solved = {.size = sizeof solved};
    icc_grid_info lattice = {.size = sizeof lattice};
    ck_assert_int_eq(icc_function_get_info(field, &solved), ICC_OK);
    ck_assert_int_eq(icc_grid_get_info(grid, &lattice), ICC_OK);
    const double *f = icc_function_values(field);
    const uint32_t root = icc_tree_root(tree);
    for (size_t v = 0; v < lattice.n_vertices; ++v)
        if (icc_grid_inside(grid)[v] && f[v] > f[root])
            ck_abort_msg("vertex %zu is higher than the root, %u", v, (unsigned)root);
    ck_assert(solved.highest == root && !solved.beside);
    ck_assert_double_eq(solved.excess, 0);
    uint32_t chosen;
    if (asked != NULL)
        ck_assert_int_eq(icc_grid_find_nearest(grid, asked, &chosen), ICC_OK);
    else
        ck_assert_int_eq(icc_grid_find_maximum(grid, &chosen, NULL, NULL, NULL), ICC_OK);
    double moved = 0;
    size_t here = root, there = chosen;
    for (int32_t k = 0; k < lattice.dim; ++k) {
        const double x = lattice.origin[k] + lattice.spacing * (double)(here % lattice.shape[k]);
        const double y = lattice.origin[k] + lattice.spacing * (double)(there % lattice.shape[k]);
        ck_assert_double_eq_tol(info.maximum[k], x,
                                1e-9 * lattice.spacing * (double)lattice.shape[k]);
        moved += (x - y) * (x - y);
        here /= lattice.shape[k];
        there /= lattice.shape[k];
    }
    ck_assert_double_eq_tol(gradient_info_of(chart).moved, sqrt(moved),
                            1e-9 * lattice.spacing * (double)lattice.shape[0]);
}

/* A point of the domain away from its boundary. */
static void pick(const icc_domain *domain, random_source *r, double *p)
{
    icc_domain_info info = {.size = sizeof info};
    int32_t where;
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    do {
        for (int32_t k = 0; k < info.dim; ++k)
            p[k] = random_between(r, info.lower[k], info.upper[k]);
        ck_assert_int_eq(icc_domain_locate(domain, 1, p, &where, NULL, NULL, NULL), ICC_OK);
    } while (where != ICC_INSIDE);
}

static double unreachable_share(const icc_chart *chart)
{
    icc_chart_report m = {.size = sizeof m};
    ck_assert_int_eq(icc_chart_get_report(chart, 1000, &m, NULL, NULL), ICC_OK);
    return m.unreachable;
}

static const int32_t PLATES[] = {ICC_FUNCTION_BILAPLACE, ICC_FUNCTION_CLAMPED};

START_TEST(the_maximum_is_where_the_function_is_greatest)
{
    random_source r = {1};
    size_t n_moved = 0;
    for (int k = 0; k < 24; ++k) {
        const shape outline = shape_number(k);
        icc_domain *domain = domain_of_shape(&outline);
        double asked[2];
        pick(domain, &r, asked);
        for (int i = 0; i < 4; ++i) {
            const icc_chart_options options =
                options_of(PLATES[i % 2], ICC_CONSTRAINTS_NONE, 40 + 5 * k, i < 2 ? NULL : asked);
            icc_chart *chart = make_chart(domain, &options);
            check_maximum(chart, options.maximum);
            n_moved += gradient_info_of(chart).moved > 0;
            icc_chart_free(chart);
        }
        icc_domain_free(domain);
    }
    ck_assert_uint_gt(n_moved, 8);
}
END_TEST

/* Where one maximum is left, hardly a point has no curve to it. */
START_TEST(curves_reach_the_moved_maximum)
{
    const shape outlines[] = {shape_l(), shape_dart(), shape_star(3, 0.4, 0.3)};
    for (size_t k = 0; k < 3; ++k) {
        icc_domain *domain = domain_of_shape(&outlines[k]);
        const double corner[2] = {
            outlines[k].xy[0] * 0.7 + outlines[k].xy[2] * 0.15 + outlines[k].xy[4] * 0.15,
            outlines[k].xy[1] * 0.7 + outlines[k].xy[3] * 0.15 + outlines[k].xy[5] * 0.15};
        int32_t where;
        ck_assert_int_eq(icc_domain_locate(domain, 1, corner, &where, NULL, NULL, NULL), ICC_OK);
        for (int32_t cells = 100; cells <= 400; cells *= 2)
            for (int i = 0; i < 2; ++i) {
                const double *asked = i > 0 && where == ICC_INSIDE ? corner : NULL;
                const icc_chart_options options =
                    options_of(ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_NEEDED, cells, asked);
                icc_chart *chart = make_chart(domain, &options);
                const icc_gradient_info info = gradient_info_of(chart);
                check_maximum(chart, asked);
                ck_assert(info.n_maxima == 1 && info.n_minima == 0 && info.n_saddles == 0);
                ck_assert_double_lt(unreachable_share(chart), 0.02);
                icc_chart_free(chart);
            }
        icc_domain_free(domain);
    }
}
END_TEST

/* "needed" moves the maximum before it imposes inequalities; with these it stays where it was asked
 * for. */
START_TEST(inequalities_hold_the_maximum)
{
    const shape outline = shape_l();
    const double asked[2] = {2.6, 0.3};
    icc_domain *domain = domain_of_shape(&outline);
    for (int32_t constraints = ICC_CONSTRAINTS_NEEDED; constraints <= ICC_CONSTRAINTS_ALL;
         ++constraints)
        for (int i = 0; i < 2; ++i) {
            const icc_chart_options options = options_of(PLATES[i], constraints, 60, asked);
            icc_chart *chart = make_chart(domain, &options);
            icc_function_info solved = {.size = sizeof solved};
            ck_assert_int_eq(icc_function_get_info(icc_chart_function(chart), &solved), ICC_OK);
            const bool expect =
                constraints == ICC_CONSTRAINTS_ALL ||
                (constraints == ICC_CONSTRAINTS_NEEDED && PLATES[i] == ICC_FUNCTION_CLAMPED);
            ck_assert_int_eq(solved.constrained, expect);
            check_maximum(chart, asked);
            ck_assert_int_eq(gradient_info_of(chart).moved > 0, !expect);
            icc_chart_free(chart);
        }
    icc_domain_free(domain);
}
END_TEST

static icc_function *make_field(icc_tree **tree, const icc_grid *grid, uint32_t root,
                                int32_t function)
{
    const icc_function_options options = {
        .size = sizeof options, .function = function, .constraints = ICC_CONSTRAINTS_NONE};
    icc_function *field;
    ck_assert_int_eq(icc_tree_create(tree, grid, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&field, *tree, &options, NULL, NULL), ICC_OK);
    return field;
}

START_TEST(a_function_says_that_it_is_greatest_beside_the_root)
{
    const shape outline = shape_l();
    const double asked[2] = {2.6, 0.3};
    icc_domain *domain = domain_of_shape(&outline);
    icc_grid *grid;
    uint32_t root;
    size_t n_beside = 0;
    ck_assert_int_eq(icc_grid_create(&grid, domain, 60, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_nearest(grid, asked, &root), ICC_OK);
    for (int32_t function = ICC_FUNCTION_DECAY; function <= ICC_FUNCTION_CLAMPED; ++function) {
        icc_tree *tree;
        icc_function *field = make_field(&tree, grid, root, function);
        icc_function_info info = {.size = sizeof info};
        icc_grid_info lattice = {.size = sizeof lattice};
        ck_assert_int_eq(icc_function_get_info(field, &info), ICC_OK);
        ck_assert_int_eq(icc_grid_get_info(grid, &lattice), ICC_OK);
        const double *f = icc_function_values(field);
        for (size_t v = 0; v < lattice.n_vertices; ++v)
            ck_assert(!icc_grid_inside(grid)[v] || !(f[v] > f[info.highest]));
        ck_assert_int_eq(info.beside, info.highest != root);
        if (info.beside)
            ck_assert_double_eq_tol(info.excess, f[info.highest] / f[root] - 1, 1e-12);
        ck_assert_int_eq(info.excess > 0, info.beside);
        ck_assert_int_eq(info.beside, function >= ICC_FUNCTION_BILAPLACE);
        n_beside += info.beside != 0;
        icc_function_free(field);
        icc_tree_free(tree);
    }
    ck_assert_uint_eq(n_beside, 2);
    icc_grid_free(grid);
    icc_domain_free(domain);
}
END_TEST

/* With the maximum where the first chart has moved it, there is nothing left to move. */
START_TEST(a_moved_maximum_stays)
{
    const shape outline = shape_l();
    const double asked[2] = {2.6, 0.3};
    icc_domain *domain = domain_of_shape(&outline);
    for (int i = 0; i < 2; ++i) {
        icc_chart_options options = options_of(PLATES[i], ICC_CONSTRAINTS_NONE, 120, asked);
        icc_chart *first = make_chart(domain, &options);
        const icc_chart_info before = info_of_chart(first);
        ck_assert_double_gt(gradient_info_of(first).moved, 0);
        options.maximum = before.maximum;
        icc_chart *again = make_chart(domain, &options);
        const icc_chart_info after = info_of_chart(again);
        ck_assert_double_eq(gradient_info_of(again).moved, 0);
        ck_assert_mem_eq(after.maximum, before.maximum, sizeof after.maximum);
        icc_chart_free(first);
        icc_chart_free(again);
    }
    icc_domain_free(domain);
}
END_TEST

START_TEST(saved_charts_have_the_same_maximum)
{
    const shape outline = shape_l();
    const double asked[2] = {2.6, 0.3};
    icc_domain *domain = domain_of_shape(&outline);
    for (int i = 0; i < 2; ++i) {
        const icc_chart_options options = options_of(PLATES[i], ICC_CONSTRAINTS_NONE, 90, asked);
        icc_chart *chart = make_chart(domain, &options), *loaded;
        const bytes saved = chart_bytes(chart);
        ck_assert_int_eq(icc_chart_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
        const bytes again = chart_bytes(loaded);
        ck_assert_uint_eq(again.n, saved.n);
        ck_assert_mem_eq(again.data, saved.data, saved.n);
        same_chart(chart, loaded);
        ck_assert_double_gt(gradient_info_of(loaded).moved, 0);
        free(saved.data);
        free(again.data);
        icc_chart_free(chart);
        icc_chart_free(loaded);
    }
    icc_domain_free(domain);
}
END_TEST

/* Masks in the plane and in space, a ball, by both solvers. In the plane the maximum moves, with
 * either of them; beyond, a plate is pointed at its load, and the maximum has not been seen to
 * move. */
START_TEST(it_is_so_for_masks_and_in_space)
{
    static surface ball;
    static const size_t shapes[3][4] = {{30, 18}, {6, 6, 4}, {3, 3, 2, 2}};
    random_source r = {3};
    icc_domain *domains[4];
    uint8_t cells[30 * 18];
    memset(cells, 1, sizeof cells);
    surface_star(&ball, 2, 0.2, &r);
    ck_assert_int_eq(icc_domain_create(&domains[3], 3, ball.n_vertices, ball.vertices, ball.n_faces,
                                       ball.faces, NULL, NULL),
                     ICC_OK);
    for (int k = 0; k < 3; ++k)
        ck_assert_int_eq(icc_domain_create_mask(&domains[k], k + 2, shapes[k], cells, NULL, NULL),
                         ICC_OK);
    size_t n_moved = 0;
    for (int k = 0; k < 4; ++k) {
        const double asked[ICC_MAX_DIM] = {k < 3 ? 2 : -0.3, 1.5, 1, 1};
        for (int i = 0; i < 5; ++i) {
            icc_chart_options options = options_of(PLATES[i / 2 % 2], ICC_CONSTRAINTS_NONE,
                                                   k == 3 ? 16 : 0, i < 4 && k < 3 ? asked : NULL);
            options.solver = i % 2 == 0 ? ICC_SOLVER_DIRECT : ICC_SOLVER_ITERATIVE;
            icc_chart *chart = make_chart(domains[k], &options);
            check_maximum(chart, options.maximum);
            n_moved += gradient_info_of(chart).moved > 0;
            icc_chart_free(chart);
        }
        icc_domain_free(domains[k]);
    }
    ck_assert_uint_eq(n_moved, 2);
}
END_TEST

START_TEST(both_charts_of_a_map_move_theirs)
{
    const shape source = shape_l();
    shape target = source;
    random_source r = {5};
    const double asked[2] = {2.6, 0.3}, target_asked[2] = {0.3, 2.5};
    double points[2 * 200], places[2 * 200];
    target.xy[2] += 0.4;
    target.xy[11] += 0.3;
    icc_domain *domains[2] = {domain_of_shape(&source), domain_of_shape(&target)};
    const icc_chart_options chart =
        options_of(ICC_FUNCTION_BILAPLACE, ICC_CONSTRAINTS_NONE, 150, asked);
    const icc_map_options options = {.size = sizeof options,
                                     .kind = ICC_MAP_CURVES,
                                     .chart = &chart,
                                     .target_maximum = target_asked};
    icc_map *map;
    size_t n_failed;
    ck_assert_int_eq(icc_map_create(&map, domains[0], domains[1], &options, NULL, NULL), ICC_OK);
    check_maximum(icc_map_source_chart(map), asked);
    check_maximum(icc_map_target_chart(map), target_asked);
    ck_assert(gradient_info_of(icc_map_source_chart(map)).moved > 0 &&
              gradient_info_of(icc_map_target_chart(map)).moved > 0);
    for (int i = 0; i < 200; ++i)
        pick(domains[0], &r, points + 2 * i);
    ck_assert_int_eq(icc_map_apply(map, 200, points, places, NULL, &n_failed, NULL), ICC_OK);
    ck_assert_uint_le(n_failed, 2);
    icc_map_free(map);
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
}
END_TEST

/* A chart that moves its maximum, each of its allocations failing once and each report answered
 * with "stop". */
START_TEST(failures_leave_nothing_behind)
{
    const shape outline = shape_l();
    const double asked[2] = {2.6, 0.3};
    icc_domain *domain = domain_of_shape(&outline);
    for (int i = 0; i < 3; ++i) {
        icc_chart_options options = options_of(PLATES[i / 2], ICC_CONSTRAINTS_NEEDED, 12, asked);
        options.solver = i == 1 ? ICC_SOLVER_ITERATIVE : ICC_SOLVER_DIRECT;
        for (int cancel = 0; cancel < 2; ++cancel) {
            icc_status status = ICC_ERR_MEMORY;
            for (size_t k = 1; status != ICC_OK; ++k) {
                faulty f = {.fail_at = cancel ? 0 : k, .cancel_at = cancel ? k : 0};
                const icc_env env = faulty_env(&f);
                icc_chart *chart;
                status = icc_chart_create(&chart, domain, &options, &env, NULL);
                ck_assert(status == ICC_OK ||
                          status == (cancel ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY));
                ck_assert_int_eq(chart == NULL, status != ICC_OK);
                icc_chart_free(chart);
                ck_assert_uint_eq(f.n_live, 0);
                ck_assert(k > 1 || status != ICC_OK);
            }
        }
    }
    icc_domain_free(domain);
}
END_TEST

static size_t read_points(const char *path, double xy[2 * MOST_VERTICES])
{
    size_t n = 0;
    FILE *file = fopen(path, "r");
    while (file != NULL && n < MOST_VERTICES &&
           fscanf(file, "%lf %lf", &xy[2 * n], &xy[2 * n + 1]) == 2)
        ++n;
    if (file != NULL)
        fclose(file);
    return n;
}

START_TEST(it_is_so_for_real_outlines)
{
    static const char *const NAMES[] = {"d01_mouse_vertebra", "d04_glyph_rf_eszett",
                                        "d08_us_newyork",     "d10_us_outline",
                                        "d15_antarctica",     "d19_disc_to_michigan"};
    static double xy[2 * MOST_VERTICES];
    random_source r = {7};
    for (size_t k = 0; k < sizeof NAMES / sizeof *NAMES; ++k) {
        char path[512];
        (void)snprintf(path, sizeof path, "%s/2d/%s.src.txt", TEST_SHARED_DATA, NAMES[k]);
        const size_t n = read_points(path, xy);
        if (n == 0)
            continue;
        icc_domain *domain;
        double asked[2];
        ck_assert_int_eq(icc_domain_create(&domain, 2, n, xy, 0, NULL, NULL, NULL), ICC_OK);
        pick(domain, &r, asked);
        for (int i = 0; i < 4; ++i) {
            const icc_chart_options options = options_of(
                PLATES[i % 2], ICC_CONSTRAINTS_NONE, i % 2 == 0 ? 200 : 80, i < 2 ? NULL : asked);
            icc_chart *chart = make_chart(domain, &options);
            check_maximum(chart, options.maximum);
            icc_chart_free(chart);
        }
        icc_domain_free(domain);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("plates");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, the_maximum_is_where_the_function_is_greatest);
    tcase_add_test(tests, curves_reach_the_moved_maximum);
    tcase_add_test(tests, inequalities_hold_the_maximum);
    tcase_add_test(tests, a_function_says_that_it_is_greatest_beside_the_root);
    tcase_add_test(tests, a_moved_maximum_stays);
    tcase_add_test(tests, saved_charts_have_the_same_maximum);
    tcase_add_test(tests, it_is_so_for_masks_and_in_space);
    tcase_add_test(tests, both_charts_of_a_map_move_theirs);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, it_is_so_for_real_outlines);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
