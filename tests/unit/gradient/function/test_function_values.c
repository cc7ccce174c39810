/* Values along the tree, edges where gradients meet or part, and critical points. */
#include "gradient/function/critical_points.h"
#include "icc/stages.h"

#include "../../../faulty.h"
#include "../../../infos.h"
#include "../../../random.h"
#include "../../../shapes.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <string.h>

enum { MAX_VERTICES = 4096 };

static icc_tree *tree_on(int32_t dim, const size_t *sides, const uint8_t *inside, uint32_t root,
                         int32_t form)
{
    const icc_tree_options options = {.size = sizeof options, .form = form};
    icc_grid *grid;
    icc_tree *tree;
    ck_assert_int_eq(icc_grid_create_mask(&grid, dim, sides, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, &options, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    return tree;
}

static icc_function *field_on(const icc_tree *tree, int32_t function)
{
    const icc_function_options options = {.size = sizeof options, .function = function};
    icc_function *field;
    ck_assert_int_eq(icc_function_create(&field, tree, &options, NULL, NULL), ICC_OK);
    return field;
}

/* All inside, so that any values can be written into the field. */
static icc_function *full_field(int32_t dim, const size_t *sides)
{
    static uint8_t inside[MAX_VERTICES];
    memset(inside, 1, sizeof inside);
    icc_tree *tree = tree_on(dim, sides, inside, 0, 0);
    icc_function *field = field_on(tree, ICC_FUNCTION_DISTANCE);
    icc_tree_free(tree);
    return field;
}

static icc_tree *random_tree(random_source *r, int32_t dim)
{
    uint8_t inside[MAX_VERTICES];
    size_t sides[ICC_MAX_DIM], n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= sides[k] = (size_t)(2 + random_below(r, dim > 3 ? 3 : 12));
    const int density = 5 + random_below(r, 6);
    for (size_t v = 0; v < n; ++v)
        inside[v] = random_below(r, 10) < density;
    const uint32_t root = (uint32_t)random_below(r, (int)n);
    inside[root] = 1;
    return tree_on(dim, sides, inside, root, 1 + random_below(r, 2));
}

/* ----------------------------------------------------------------- values */

START_TEST(values_fall_with_the_generation)
{
    random_source r = {1};
    for (int round = 0; round < 500; ++round) {
        icc_tree *tree = random_tree(&r, 1 + round % 4);
        icc_function *decay = field_on(tree, ICC_FUNCTION_DECAY);
        icc_function *distance = field_on(tree, ICC_FUNCTION_DISTANCE);
        const int32_t *generation = icc_tree_generations(tree);
        for (size_t v = 0; v < tree->grid->n_vertices; ++v) {
            const double a = icc_function_values(decay)[v], b = icc_function_values(distance)[v];
            ck_assert((isnan(a) != 0) == (generation[v] < 0) &&
                      (isnan(b) != 0) == (generation[v] < 0));
            if (generation[v] < 0)
                continue;
            ck_assert(b == -generation[v]);
            ck_assert_double_eq_tol(a, 10 * pow(0.95, generation[v]), 1e-12);
            const uint32_t parent = icc_tree_parents(tree)[v];
            ck_assert(parent == UINT32_MAX || a == 0.95 * icc_function_values(decay)[parent]);
        }
        icc_tree_free(tree); /* the fields keep it */
        ck_assert(icc_function_values(decay)[decay->tree->root] == 10);
        icc_function_free(decay);
        icc_function_free(distance);
    }
}
END_TEST

START_TEST(values_fall_however_deep_the_tree)
{
    enum { N = 20000 };
    uint8_t *inside = malloc(N);
    memset(inside, 1, N);
    icc_tree *tree = tree_on(1, (size_t[]){N}, inside, 0, 0);
    icc_function *field = field_on(tree, 0);
    const double *f = icc_function_values(field);
    for (size_t v = 1; v < N; ++v)
        ck_assert(f[v] < f[v - 1]);
    ck_assert(f[13000] > 0 && f[N - 1] < 0);
    const icc_function_report report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima, 0);
    ck_assert_uint_eq(report.n_saddles, 0);
    icc_function_free(field);
    icc_tree_free(tree);
    free(inside);
}
END_TEST

/* A function from 1 down to 2^-(20 n), assigned to the rows of a path. */
static icc_function *steep_field(size_t n)
{
    uint8_t inside[MAX_VERTICES] = {0};
    memset(inside + 2, 1, n);
    icc_tree *tree = tree_on(1, (size_t[]){n + 4}, inside, 2, 0);
    icc_function *field;
    iccp_env env;
    iccp_unknowns unknowns;
    double fraction[MAX_VERTICES];
    int32_t exponent[MAX_VERTICES];
    const iccp_scaled f = {fraction, exponent};
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_function_new(&field, tree, &env), ICC_OK);
    ck_assert_int_eq(iccp_unknowns_create(&unknowns, tree, &env), ICC_OK);
    for (size_t k = 0; k < n; ++k)
        iccp_scaled_set(&f, k, 1 + 0.5 * (double)(k % 2), -20 * (int32_t)k);
    ck_assert_int_eq(iccp_function_assign(field, &unknowns, &f), ICC_OK);
    iccp_unknowns_free(&unknowns);
    icc_tree_free(tree);
    return field;
}

START_TEST(values_go_on_beyond_doubles)
{
    enum { N = 200 };
    icc_function *field = steep_field(N);
    ck_assert_ptr_nonnull(field->exponent);
    const double *f = icc_function_values(field), *u = icc_function_logs(field);
    for (uint32_t v = 2; v < N + 2; ++v) {
        const int k = (int)v - 2;
        ck_assert(f[v] == ldexp(1 + 0.5 * (k % 2), -20 * k));
        ck_assert_double_eq_tol(u[v], log(1 + 0.5 * (k % 2)) - 20 * k * log(2), 1e-11);
        uint32_t ends[2] = {v, v + 1};
        double local[2];
        iccp_function_local(field, 2, ends, local);
        const double expected = k == N - 1 ? 0 : (k % 2 ? 1 / 1.5 : 1.5) * 0x1p-20;
        ck_assert_double_eq_tol(local[1] / local[0], expected, 1e-20);
        ck_assert_int_eq(iccp_function_compare(field, v, v + 1), 1);
        ck_assert_int_eq(iccp_function_compare(field, v + 1, v), -1);
        ck_assert_int_eq(iccp_function_compare(field, v, v), 0);
    }
    ck_assert(f[N + 1] == 0 && f[1] == 0 && u[1] == -HUGE_VAL); /* 2^-3980 */
    ck_assert(f[0] == -f[2]);                                   /* beyond the zero: mirrored */
    ck_assert_double_eq(field->info.least_log, u[N + 1]);
    const icc_function_report report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima + report.n_saddles, 0);
    icc_function_free(field);
    field = steep_field(40); /* 2^-780 needs no exponents */
    ck_assert(field->exponent == NULL && field->plain == NULL);
    ck_assert(field->has_logs && iccp_once_get(&field->logs) == NULL);
    ck_assert_double_eq(iccp_function_log(field, 41), field->info.least_log);
    ck_assert(iccp_function_logs(field)[41] == field->info.least_log);
    icc_function_free(field);
}
END_TEST

/* ------------------------------------------------------------------ edges */

/* A triangle of the grid by its corners, which may lie beyond the grid. */
typedef struct triangle {
    int64_t x[3], y[3];
} triangle;

/* How much the triangle's gradient points to its edge from a to b, times a positive number: exact
 * for whole values. */
static int64_t towards_edge(const icc_function *field, const triangle *t, const int64_t a[2],
                            const int64_t b[2])
{
    const int64_t nx = (int64_t)field->tree->grid->shape[0];
    int64_t f[3];
    for (int c = 0; c < 3; ++c)
        f[c] = (int64_t)field->values[t->x[c] + nx * t->y[c]];
    const int64_t x1 = t->x[1] - t->x[0], y1 = t->y[1] - t->y[0], f1 = f[1] - f[0];
    const int64_t x2 = t->x[2] - t->x[0], y2 = t->y[2] - t->y[0], f2 = f[2] - f[0];
    const int64_t area = x1 * y2 - x2 * y1;
    const int64_t gx = (f1 * y2 - f2 * y1) * area, gy = (x1 * f2 - x2 * f1) * area;
    /* The normal of the edge that points out of the triangle. */
    int64_t n[2] = {b[1] - a[1], a[0] - b[0]};
    const int64_t middle[2] = {t->x[0] + t->x[1] + t->x[2], t->y[0] + t->y[1] + t->y[2]};
    if (n[0] * (middle[0] - 3 * a[0]) + n[1] * (middle[1] - 3 * a[1]) > 0) {
        n[0] = -n[0];
        n[1] = -n[1];
    }
    return gx * n[0] + gy * n[1];
}

static bool usable(const icc_function *field, const triangle *t, bool *any_inside)
{
    const icc_grid *grid = field->tree->grid;
    for (int c = 0; c < 3; ++c) {
        if (t->x[c] < 0 || t->y[c] < 0 || t->x[c] >= (int64_t)grid->shape[0] ||
            t->y[c] >= (int64_t)grid->shape[1])
            return false;
        const int64_t v = t->x[c] + (int64_t)grid->shape[0] * t->y[c];
        if (isnan(field->values[v]))
            return false;
        *any_inside = *any_inside || grid->inside[v];
    }
    return true;
}

/* The kind of the edge from (i, j) along (dx, dy), or -1 when it is not one to look at. */
static int32_t kind_of(const icc_function *field, int64_t i, int64_t j, int64_t dx, int64_t dy)
{
    const int64_t a[2] = {i, j}, b[2] = {i + dx, j + dy};
    triangle left = {{i, i + 1, i}, {j, j + 1, j + 1}};
    triangle right = {{i, i + 1, i + 1}, {j, j, j + 1}};
    if (dy == 0) {
        left = right;
        right = (triangle){{i, i + 1, i}, {j, j, j - 1}};
    } else if (dx == 0) {
        right = left;
        left = (triangle){{i - 1, i, i}, {j, j, j + 1}};
    }
    bool any_inside = false;
    if (!usable(field, &left, &any_inside) || !usable(field, &right, &any_inside) || !any_inside)
        return -1;
    const int64_t l = towards_edge(field, &left, a, b), r = towards_edge(field, &right, a, b);
    return l > 0 && r > 0 ? ICC_EDGE_COMPRESSION : l < 0 && r < 0 ? ICC_EDGE_EXPANSION : 0;
}

START_TEST(edges_are_what_gradients_say)
{
    static uint32_t edges[6 * MAX_VERTICES];
    static int32_t kinds[3 * MAX_VERTICES];
    random_source r = {2};
    size_t n_kinds[3] = {0};
    for (int round = 0; round < 600; ++round) {
        icc_tree *tree = random_tree(&r, 2);
        icc_function *field = field_on(tree, ICC_FUNCTION_DISTANCE);
        for (size_t v = 0; round % 2 == 1 && v < tree->grid->n_vertices; ++v)
            if (!isnan(field->values[v]))
                field->values[v] = random_below(&r, 5);
        size_t n_edges, n_tested, n = 0, n_expected = 0;
        ck_assert_int_eq(
            icc_function_get_edges(field, 3 * MAX_VERTICES, edges, kinds, &n_edges, &n_tested),
            ICC_OK);
        for (size_t v = 0; v < tree->grid->n_vertices; ++v)
            for (int e = 1; e <= 3; ++e) {
                const size_t nx = tree->grid->shape[0], dx = e != 2, dy = e != 1;
                const int32_t kind =
                    kind_of(field, (int64_t)(v % nx), (int64_t)(v / nx), (int64_t)dx, (int64_t)dy);
                n_expected += kind >= 0;
                if (kind <= 0)
                    continue;
                ck_assert_uint_lt(n, n_edges);
                ck_assert_uint_eq(edges[2 * n], v);
                ck_assert_uint_eq(edges[2 * n + 1], v + dx + dy * nx);
                ck_assert_int_eq(kinds[n++], kind);
                ++n_kinds[kind];
            }
        ck_assert_uint_eq(n, n_edges);
        ck_assert_uint_eq(n_tested, n_expected);
        icc_function_free(field);
        icc_tree_free(tree);
    }
    ck_assert_uint_gt(n_kinds[ICC_EDGE_COMPRESSION], 1000);
    ck_assert_uint_gt(n_kinds[ICC_EDGE_EXPANSION], 1000);
}
END_TEST

/* Along a diagonal the sum of two values is compared with twice a third: a rounded sum would
 * tie. */
START_TEST(diagonals_are_compared_exactly)
{
    static const double sums[4][3] = {
        {0x1p53, 1, 0x1p52}, {1, 0x1p-60, 0.5}, {0x1p54, -1, 0x1p53}, {0x1p53 + 2, 1, 0x1p52 + 1}};
    static const int signs[4] = {1, 1, -1, 1}; /* of a + b - 2 c */
    for (int i = 0; i < 4; ++i)
        for (int flip = -1; flip <= 1; flip += 2) {
            icc_function *field = full_field(2, (size_t[]){2, 2});
            field->values[0] = flip * sums[i][0];
            field->values[3] = flip * sums[i][1];
            field->values[1] = field->values[2] = flip * sums[i][2];
            uint32_t edge[2];
            int32_t kind;
            size_t n_edges, n_tested;
            ck_assert_int_eq(icc_function_get_edges(field, 1, edge, &kind, &n_edges, &n_tested),
                             ICC_OK);
            ck_assert_uint_eq(n_tested, 1);
            ck_assert_uint_eq(n_edges, 1);
            ck_assert_int_eq(kind, flip * signs[i] > 0 ? ICC_EDGE_COMPRESSION : ICC_EDGE_EXPANSION);
            ck_assert(edge[0] == 0 && edge[1] == 3);
            icc_function_free(field);
        }
}
END_TEST

START_TEST(edges_are_counted_beyond_capacity)
{
    random_source r = {3};
    icc_function *field = full_field(2, (size_t[]){30, 30});
    for (size_t v = 0; v < 900; ++v)
        field->values[v] = random_unit(&r);
    uint32_t edges[20];
    int32_t kinds[10];
    size_t n_all, n_again, n_tested;
    ck_assert_int_eq(icc_function_get_edges(field, 0, NULL, NULL, &n_all, NULL), ICC_OK);
    ck_assert_uint_gt(n_all, 100);
    memset(edges, 0xff, sizeof edges);
    ck_assert_int_eq(icc_function_get_edges(field, 9, edges, kinds, &n_again, &n_tested), ICC_OK);
    ck_assert_uint_eq(n_again, n_all);
    ck_assert(edges[17] != UINT32_MAX && edges[18] == UINT32_MAX);
    icc_facet_report report = {.size = sizeof report};
    ck_assert_int_eq(icc_function_get_facets(field, 0, NULL, NULL, &report, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(report.n_tested, n_tested);
    ck_assert_uint_eq(report.n_compression + report.n_expansion, n_all);
    ck_assert_uint_eq(n_tested, 29 * 29 + 2 * 29 * 28); /* all but those of the rim */
    icc_function_free(field);
}
END_TEST

/* -------------------------------------------------------- critical points */

static bool higher(const icc_function *field, size_t u, size_t v)
{
    const double *f = field->values;
    return field->tree->grid->inside[u] && !isnan(f[u]) && (f[u] > f[v] || (f[u] == f[v] && u > v));
}

/* By going round each vertex and counting how often it changes between higher and lower. */
static icc_function_report count_turns(const icc_function *field)
{
    static const int around[6][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}};
    const icc_grid *grid = field->tree->grid;
    icc_function_report report = {.critical = UINT32_MAX};
    for (size_t v = 0; v < grid->n_vertices; ++v) {
        if (!grid->inside[v] || isnan(field->values[v]))
            continue;
        bool up[6];
        int n_up = 0, n_turns = 0;
        for (int m = 0; m < 6; ++m) {
            const size_t i = v % grid->shape[0] + (size_t)around[m][0];
            const size_t j = v / grid->shape[0] + (size_t)around[m][1];
            up[m] = i < grid->shape[0] && j < grid->shape[1] &&
                    higher(field, i + grid->shape[0] * j, v);
            n_up += up[m];
        }
        for (int m = 0; m < 6; ++m)
            n_turns += up[m] != up[(m + 1) % 6];
        report.n_maxima += n_up == 0;
        report.n_minima += n_up == 6;
        report.n_saddles += n_turns > 2;
        if (n_turns != 2 && v != field->tree->root && report.critical == UINT32_MAX)
            report.critical = (uint32_t)v;
    }
    return report;
}

START_TEST(critical_points_in_the_plane)
{
    random_source r = {4};
    icc_function_report sum = {0};
    for (int round = 0; round < 800; ++round) {
        icc_tree *tree = random_tree(&r, 2);
        icc_function *field = field_on(tree, 0);
        for (size_t v = 0; round % 2 == 1 && v < tree->grid->n_vertices; ++v)
            if (!isnan(field->values[v]))
                field->values[v] = random_below(&r, 5);
        const icc_function_report found = report_of_function(field), expected = count_turns(field);
        ck_assert_uint_eq(found.n_maxima, expected.n_maxima);
        ck_assert_uint_eq(found.n_minima, expected.n_minima);
        ck_assert_uint_eq(found.n_saddles, expected.n_saddles);
        ck_assert_uint_eq(found.critical, expected.critical);
        sum.n_minima += found.n_minima;
        sum.n_saddles += found.n_saddles;
        icc_function_free(field);
        icc_tree_free(tree);
    }
    ck_assert(sum.n_minima > 100 && sum.n_saddles > 1000);
}
END_TEST

/* On a box, values outside being lower, the numbers of critical points of a function add up like
 * the Euler characteristic of a ball; with one peak there is nothing else. */
START_TEST(one_peak_in_a_box)
{
    random_source r = {5};
    for (int32_t dim = 1; dim <= 5; ++dim)
        for (int round = 0; round < 20; ++round) {
            size_t sides[ICC_MAX_DIM];
            double peak[ICC_MAX_DIM], slope[ICC_MAX_DIM];
            for (int32_t k = 0; k < dim; ++k) {
                sides[k] = (size_t)(2 + random_below(&r, dim > 3 ? 3 : 5));
                peak[k] = random_below(&r, (int)sides[k]);
                slope[k] = random_between(&r, 0.1, 1);
            }
            icc_function *field = full_field(dim, sides);
            const icc_grid *grid = field->tree->grid;
            for (uint32_t v = 0; v < grid->n_vertices; ++v) {
                field->values[v] = 0;
                for (int32_t k = 0; k < dim; ++k)
                    field->values[v] -= slope[k] * fabs(iccp_grid_coordinate(grid, v, k) - peak[k]);
                if (field->values[v] == 0)
                    field->tree->root = v;
            }
            const icc_function_report report = report_of_function(field);
            ck_assert_uint_eq(report.n_maxima, 1);
            ck_assert_uint_eq(report.n_minima, 0);
            ck_assert_uint_eq(report.n_saddles, 0);
            ck_assert_uint_eq(report.critical, UINT32_MAX);
            icc_function_free(field);
        }
}
END_TEST

START_TEST(critical_points_in_space)
{
    icc_function *field = full_field(3, (size_t[]){5, 5, 5});
    for (uint32_t v = 0; v < 125; ++v)
        field->values[v] = -(double)v;
    ck_assert_uint_eq(report_of_function(field).n_maxima, 1);
    field->values[62] = -1000; /* the middle: a pit, and with it a saddle */
    icc_function_report report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima, 1);
    ck_assert_uint_ge(report.n_saddles, 1);
    ck_assert_uint_le(report.critical, 62);
    field->values[62] = 1000; /* a second peak */
    report = report_of_function(field);
    ck_assert_uint_eq(report.n_maxima, 2);
    ck_assert_uint_eq(report.n_minima, 0);
    ck_assert_uint_ge(report.n_saddles, 1);
    icc_function_free(field);
}
END_TEST

START_TEST(decay_on_boxes_is_clean)
{
    static uint8_t inside[MAX_VERTICES];
    memset(inside, 1, sizeof inside);
    random_source r = {6};
    for (int32_t dim = 2; dim <= 5; ++dim)
        for (int round = 0; round < 20; ++round) {
            size_t sides[ICC_MAX_DIM], n = 1;
            for (int32_t k = 0; k < dim; ++k)
                n *= sides[k] = (size_t)(2 + random_below(&r, dim > 3 ? 3 : 5));
            const uint32_t root = (uint32_t)random_below(&r, (int)n);
            icc_tree *tree = tree_on(dim, sides, inside, root, 0);
            icc_function *field = field_on(tree, 0);
            const icc_function_report report = report_of_function(field);
            ck_assert_uint_eq(report.n_maxima, 1);
            ck_assert_uint_eq(report.n_minima + report.n_saddles, 0);
            ck_assert_uint_eq(report.critical, UINT32_MAX);
            icc_function_free(field);
            icc_tree_free(tree);
        }
}
END_TEST

START_TEST(threads_do_not_change_the_report)
{
    enum { SIDE = 400 };
    random_source r = {7};
    uint8_t *inside = malloc(SIDE * SIDE);
    memset(inside, 1, SIDE * SIDE);
    icc_tree *tree = tree_on(2, (size_t[]){SIDE, SIDE}, inside, 0, 0);
    icc_function *field = field_on(tree, 0);
    for (size_t v = 0; v < SIDE * SIDE; ++v)
        field->values[v] = random_unit(&r);
    const icc_function_report one = report_of_function(field);
    ck_assert_uint_gt(one.n_saddles, 1000);
    for (int32_t threads = 2; threads <= 8; ++threads) {
        const icc_env env = {.size = sizeof env, .threads = threads};
        icc_function_report many = {.size = sizeof many};
        ck_assert_int_eq(icc_function_get_report(field, &many, &env, NULL), ICC_OK);
        ck_assert_mem_eq(&one, &many, sizeof one);
    }
    icc_function_free(field);
    icc_tree_free(tree);
    free(inside);
}
END_TEST

/* ----------------------------------------------------------- triangulation */

static int64_t doubled_area(const double *a, const double *b, const double *c)
{
    return (int64_t)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
}

START_TEST(triangles_fill_the_polygon)
{
    static const double points[2 * 8] = {0, 0, 6, 0, 6, 2, 2, 2, 2, 6, 0, 6, 1, 1, 3, 1};
    static const double scale[3] = {1, 0x1p-20, 0x1p900}, offset[3] = {0, 0x1p30, 0};
    for (int i = 0; i < 3; ++i) {
        double moved[2 * 8];
        for (int k = 0; k < 16; ++k)
            moved[k] = points[k] * scale[i] + offset[i];
        uint32_t triangles[3 * (2 * 8 - 6 - 2)];
        ck_assert_int_eq(icc_triangulate(6, 8, moved, triangles, NULL, NULL), ICC_OK);
        int64_t area = 0;
        for (int t = 0; t < 8; ++t) {
            const int64_t one =
                doubled_area(points + 2 * triangles[3 * t], points + 2 * triangles[3 * t + 1],
                             points + 2 * triangles[3 * t + 2]);
            ck_assert_int_gt(one, 0);
            area += one;
        }
        ck_assert_int_eq(area, 2 * 20);
    }
}
END_TEST

START_TEST(triangulation_refuses)
{
    uint32_t triangles[30];
    icc_error err = {.size = sizeof err};
    double p[12] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 2};
    ck_assert_int_eq(icc_triangulate(4, 6, NULL, triangles, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_triangulate(4, 6, p, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_triangulate(2, 6, p, triangles, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_triangulate(4, 3, p, triangles, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_triangulate(4, SIZE_MAX, p, triangles, NULL, NULL), ICC_ERR_ARGUMENT);
    static const double bad[4][2] = {{NAN, 1}, {HUGE_VAL, 1}, {5, 1}, {1e-300, 1}};
    static const icc_status expected[4] = {ICC_ERR_ARGUMENT, ICC_ERR_ARGUMENT, ICC_ERR_OUTSIDE,
                                           ICC_ERR_ARGUMENT};
    for (int i = 0; i < 4; ++i) {
        memcpy(p + 10, bad[i], sizeof bad[i]);
        ck_assert_int_eq(icc_triangulate(4, 6, p, triangles, NULL, &err), expected[i]);
        ck_assert_int_eq(err.index, 5);
    }
    memcpy(p + 10, p + 8, 2 * sizeof *p); /* repeats point 4 */
    ck_assert_int_ne(icc_triangulate(4, 6, p, triangles, NULL, &err), ICC_OK);
    ck_assert(err.index == 4 || err.index == 5);
    memcpy(p + 10, (double[]){0, 2}, 2 * sizeof *p); /* on the boundary */
    ck_assert_int_eq(icc_triangulate(4, 6, p, triangles, NULL, &err), ICC_ERR_OUTSIDE);
    ck_assert_int_eq(err.index, 5);
    memcpy(p + 4, (double[]){-1, 4, 5, 4}, 4 * sizeof *p); /* crosses itself */
    ck_assert_int_eq(icc_triangulate(4, 5, p, triangles, NULL, &err), ICC_ERR_BOUNDARY);
}
END_TEST

/* ---------------------------------------------------------- failing, wrong */

static icc_status make_and_verify(const icc_env *env, icc_error *err, void *tree)
{
    icc_function *field = (icc_function *)&field;
    icc_status status = icc_function_create(&field, tree, NULL, env, err);
    ck_assert((field == NULL) == (status != ICC_OK));
    icc_function_report report = {.size = sizeof report, .n_maxima = 77};
    if (status == ICC_OK) {
        status = icc_function_get_report(field, &report, env, err);
        ck_assert_uint_eq(report.n_maxima, status == ICC_OK ? 1 : 77);
    }
    icc_function_free(field);
    return status;
}

static icc_status triangulate_square(const icc_env *env, icc_error *err, void *unused)
{
    (void)unused;
    const double p[12] = {0, 0, 4, 0, 4, 4, 0, 4, 1, 1, 3, 2};
    uint32_t triangles[3 * 6];
    return icc_triangulate(4, 6, p, triangles, env, err);
}

START_TEST(every_failure_is_reported)
{
    const uint8_t inside[4] = {1, 1, 0, 1};
    icc_tree *tree = tree_on(2, (size_t[]){2, 2}, inside, 0, 0);
    faulty_sweep(make_and_verify, tree);
    ck_assert_uint_eq(atomic_load(&tree->references), 1);
    icc_tree_free(tree);
    faulty_sweep(triangulate_square, NULL);
}
END_TEST

START_TEST(wrong_arguments)
{
    const uint8_t inside[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    icc_tree *tree = tree_on(3, (size_t[]){2, 2, 2}, inside, 0, 0);
    icc_function *field = (icc_function *)&field;
    ck_assert_int_eq(icc_function_create(NULL, tree, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_create(&field, NULL, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(field);
    icc_function_options options = {.size = sizeof options, .function = 7};
    ck_assert_int_eq(icc_function_create(&field, tree, &options, NULL, NULL), ICC_ERR_ARGUMENT);
    options = (icc_function_options){.size = 0};
    ck_assert_int_eq(icc_function_create(&field, tree, &options, NULL, NULL), ICC_ERR_ARGUMENT);
    field = field_on(tree, 0);
    icc_function_report report = {.size = 0};
    ck_assert_int_eq(icc_function_get_report(field, &report, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_get_report(field, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_get_report(NULL, &report, NULL, NULL), ICC_ERR_ARGUMENT);
    size_t n;
    ck_assert_int_eq(icc_function_get_edges(field, 0, NULL, NULL, &n, NULL), ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(icc_function_get_edges(NULL, 0, NULL, NULL, &n, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_get_edges(field, 0, NULL, NULL, NULL, NULL), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_get_edges(field, 1, NULL, NULL, &n, NULL), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(icc_function_values(NULL));
    icc_function_free(NULL);
    icc_function_free(field);
    icc_tree_free(tree);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("field");
    TCase *tests = tcase_create("field");
    tcase_add_test(tests, values_fall_with_the_generation);
    tcase_add_test(tests, values_fall_however_deep_the_tree);
    tcase_add_test(tests, values_go_on_beyond_doubles);
    tcase_add_test(tests, edges_are_what_gradients_say);
    tcase_add_test(tests, diagonals_are_compared_exactly);
    tcase_add_test(tests, edges_are_counted_beyond_capacity);
    tcase_add_test(tests, critical_points_in_the_plane);
    tcase_add_test(tests, one_peak_in_a_box);
    tcase_add_test(tests, critical_points_in_space);
    tcase_add_test(tests, decay_on_boxes_is_clean);
    tcase_add_test(tests, threads_do_not_change_the_report);
    tcase_add_test(tests, triangles_fill_the_polygon);
    tcase_add_test(tests, triangulation_refuses);
    tcase_add_test(tests, every_failure_is_reported);
    tcase_add_test(tests, wrong_arguments);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
