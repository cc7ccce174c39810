/* Compression and expansion facets against an enumeration of all simplices in exact integers, and
 * against the curves that merge there. */
#include "../faulty.h"
#include "../random.h"
#include "../suite.h"

#include <icc/stages.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIM = 4, MOST_VERTICES = 1296, MOST_SIDES = 200000 };

static icc_function *function_on(int32_t dim, const size_t *shape, const uint8_t *inside,
                                 uint32_t root, const double *values)
{
    icc_grid *grid;
    icc_tree *tree;
    icc_function *function;
    ck_assert_int_eq(icc_grid_create_mask(&grid, dim, shape, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create_values(&function, tree, values, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    icc_tree_free(tree);
    return function;
}

/* Random integers on a random mask. */
static icc_function *random_function(random_source *r, int32_t dim, int most)
{
    static const int SIDES[MOST_DIM + 1] = {0, 40, 14, 7, 5};
    uint8_t inside[MOST_VERTICES];
    double values[MOST_VERTICES];
    size_t shape[MOST_DIM], n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= shape[k] = (size_t)(2 + random_below(r, SIDES[dim] - 1));
    const int density = 4 + random_below(r, 7);
    for (size_t v = 0; v < n; ++v) {
        inside[v] = random_below(r, 10) < density;
        values[v] = random_below(r, most);
    }
    const uint32_t root = (uint32_t)random_below(r, (int)n);
    inside[root] = 1;
    return function_on(dim, shape, inside, root, values);
}

/* ---- the enumeration ---- */

/* A simplex at a facet: the facet's corners, the simplex's own, and to which side of the facet the
 * gradient of the simplex points: 1 away from the facet, -1 to it. */
typedef struct side {
    uint32_t corner[MOST_DIM], apex;
    int sign;
    bool any_inside;
} side;

typedef struct enumeration {
    int32_t dim;
    size_t n;
    side sides[MOST_SIDES];
} enumeration;

static int compare_corners(const uint32_t *a, const uint32_t *b, int32_t dim)
{
    for (int32_t k = 0; k < dim; ++k)
        if (a[k] != b[k])
            return a[k] < b[k] ? -1 : 1;
    return 0;
}

static int32_t sorted_dim;

static int compare_sides(const void *a, const void *b)
{
    return compare_corners(((const side *)a)->corner, ((const side *)b)->corner, sorted_dim);
}

static int64_t exact_determinant(int n, int64_t m[MOST_DIM][MOST_DIM])
{
    if (n == 0)
        return 1;
    int64_t sum = 0;
    for (int c = 0; c < n; ++c) {
        int64_t minor[MOST_DIM][MOST_DIM];
        for (int i = 1; i < n; ++i)
            for (int k = 0, to = 0; k < n; ++k)
                if (k != c)
                    minor[i - 1][to++] = m[i][k];
        sum += (c % 2 ? -1 : 1) * m[0][c] * exact_determinant(n - 1, minor);
    }
    return sum;
}

/* The gradient of the linear function with these values at the corners of a simplex of volume
 * 1 / dim!, by Cramer's rule. */
static void find_gradient(int32_t dim, int64_t at[][MOST_DIM], const int64_t *f, int64_t *gradient)
{
    int64_t m[MOST_DIM][MOST_DIM];
    for (int32_t i = 0; i < dim; ++i)
        for (int32_t k = 0; k < dim; ++k)
            m[i][k] = at[i + 1][k] - at[0][k];
    const int64_t whole = exact_determinant(dim, m);
    ck_assert(whole == 1 || whole == -1);
    for (int32_t k = 0; k < dim; ++k) {
        int64_t replaced[MOST_DIM][MOST_DIM];
        memcpy(replaced, m, sizeof m);
        for (int32_t i = 0; i < dim; ++i)
            replaced[i][k] = f[i + 1] - f[0];
        gradient[k] = exact_determinant(dim, replaced) * whole;
    }
}

/* Adds the facets of a simplex whose corners all have values. */
static void add_simplex(enumeration *e, const icc_grid_info *info, const uint8_t *inside,
                        const double *values, const uint32_t *corner)
{
    const int32_t dim = e->dim;
    int64_t at[MOST_DIM + 1][MOST_DIM], f[MOST_DIM + 1] = {0}, gradient[MOST_DIM], inward[MOST_DIM];
    bool any_inside = false;
    for (int32_t i = 0; i <= dim; ++i) {
        size_t rest = corner[i];
        if (isnan(values[corner[i]]))
            return;
        any_inside |= inside[corner[i]];
        f[i] = (int64_t)values[corner[i]];
        for (int32_t k = 0; k < dim; ++k) {
            at[i][k] = (int64_t)(rest % info->shape[k]);
            rest /= info->shape[k];
        }
    }
    find_gradient(dim, at, f, gradient);
    for (int32_t i = 0; i <= dim; ++i) {
        side *s = &e->sides[e->n++];
        ck_assert_uint_le(e->n, MOST_SIDES);
        int64_t one[MOST_DIM + 1] = {0}, speed = 0;
        one[i] = 1;
        find_gradient(dim, at, one, inward);
        for (int32_t k = 0; k < dim; ++k)
            speed += gradient[k] * inward[k];
        int32_t n = 0;
        for (int32_t c = 0; c <= dim; ++c)
            if (c != i)
                s->corner[n++] = corner[c];
        s->apex = corner[i];
        s->sign = (speed > 0) - (speed < 0);
        s->any_inside = any_inside;
    }
}

/* Goes through all orders of the axes at one cell. `taken` has those that are used. */
static void add_orders(enumeration *e, const icc_grid_info *info, const uint8_t *inside,
                       const double *values, uint32_t *corner, int32_t n, unsigned taken)
{
    uint32_t stride = 1;
    if (n == e->dim)
        add_simplex(e, info, inside, values, corner);
    for (int32_t k = 0; k < e->dim; ++k) {
        corner[n + 1] = corner[n] + stride;
        if (!(taken >> k & 1))
            add_orders(e, info, inside, values, corner, n + 1, taken | 1u << k);
        stride *= (uint32_t)info->shape[k];
    }
}

/* Lists the sides of all facets. The two sides of a facet follow each other. */
static enumeration *enumerate(const icc_function *function)
{
    const icc_grid *grid = icc_tree_grid(icc_function_tree(function));
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    enumeration *e = malloc(sizeof *e);
    e->dim = info.dim;
    e->n = 0;
    for (uint32_t v = 0; v < info.n_vertices; ++v) {
        size_t rest = v;
        bool cell = true;
        uint32_t corner[MOST_DIM + 2] = {v};
        for (int32_t k = 0; k < info.dim; ++k) {
            cell = cell && rest % info.shape[k] + 1 < info.shape[k];
            rest /= info.shape[k];
        }
        if (cell)
            add_orders(e, &info, icc_grid_inside(grid), icc_function_values(function), corner, 0,
                       0);
    }
    sorted_dim = e->dim;
    qsort(e->sides, e->n, sizeof *e->sides, compare_sides);
    return e;
}

/* Returns false if side k is not the first of two sides with an inside corner. */
static bool is_facet(const enumeration *e, size_t k)
{
    const side *s = &e->sides[k];
    return k + 1 < e->n && compare_sides(s, s + 1) == 0 && (s[0].any_inside || s[1].any_inside);
}

static int32_t kind_of(const side *s)
{
    if (s[0].sign == 0 || s[0].sign != s[1].sign)
        return 0;
    return s[0].sign < 0 ? ICC_EDGE_COMPRESSION : ICC_EDGE_EXPANSION;
}

/* ---- facets ---- */

typedef struct listed {
    uint32_t corner[MOST_DIM];
    int32_t kind;
} listed;

static int compare_listed(const void *a, const void *b)
{
    return compare_corners(((const listed *)a)->corner, ((const listed *)b)->corner, sorted_dim);
}

/* Lists the facets, in order. */
static listed *list(const icc_function *function, int32_t dim, icc_facet_report *report)
{
    *report = (icc_facet_report){.size = sizeof *report};
    ck_assert_int_eq(icc_function_get_facets(function, 0, NULL, NULL, report, NULL, NULL), ICC_OK);
    const size_t n = report->n_compression + report->n_expansion;
    uint32_t *facets = malloc((n + 1) * (size_t)dim * sizeof *facets);
    int32_t *kinds = malloc((n + 1) * sizeof *kinds);
    listed *all = malloc((n + 1) * sizeof *all);
    icc_facet_report again = {.size = sizeof again};
    ck_assert_int_eq(icc_function_get_facets(function, n, facets, kinds, &again, NULL, NULL),
                     ICC_OK);
    ck_assert(memcmp(report, &again, sizeof again) == 0);
    for (size_t i = 0; i < n; ++i) {
        memcpy(all[i].corner, facets + i * (size_t)dim, (size_t)dim * sizeof *facets);
        all[i].kind = kinds[i];
    }
    sorted_dim = dim;
    qsort(all, n, sizeof *all, compare_listed);
    free(facets);
    free(kinds);
    return all;
}

START_TEST(facets_are_what_gradients_say)
{
    random_source r = {1};
    size_t n_kinds[MOST_DIM + 1][3] = {{0}};
    for (int round = 0; round < 200; ++round) {
        const int32_t dim = 1 + round % MOST_DIM;
        icc_function *function = random_function(&r, dim, round % 3 ? 5 : 1000000);
        icc_facet_report report;
        listed *all = list(function, dim, &report);
        enumeration *e = enumerate(function);
        size_t n = 0, n_tested = 0;
        for (size_t k = 0; k < e->n; ++k) {
            if (!is_facet(e, k))
                continue;
            const int32_t kind = kind_of(&e->sides[k]);
            ++n_tested;
            ++n_kinds[dim][kind];
            if (kind == 0)
                continue;
            ck_assert_uint_lt(n, report.n_compression + report.n_expansion);
            ck_assert_int_eq(compare_corners(all[n].corner, e->sides[k].corner, dim), 0);
            ck_assert_int_eq(all[n++].kind, kind);
        }
        ck_assert_uint_eq(n, report.n_compression + report.n_expansion);
        ck_assert_uint_eq(n_tested, report.n_tested);
        free(all);
        free(e);
        icc_function_free(function);
    }
    for (int32_t dim = 1; dim <= MOST_DIM; ++dim)
        for (int kind = 0; kind < 3; ++kind)
            ck_assert_uint_gt(n_kinds[dim][kind], 50);
}
END_TEST

START_TEST(facets_of_the_plane_are_its_edges)
{
    random_source r = {2};
    for (int round = 0; round < 50; ++round) {
        enum { CAPACITY = 3 * MOST_VERTICES };
        static uint32_t facets[2 * CAPACITY], edges[2 * CAPACITY];
        static int32_t kinds[2][CAPACITY];
        icc_function *function = random_function(&r, 2, 9);
        icc_facet_report report = {.size = sizeof report};
        size_t n, n_tested;
        ck_assert_int_eq(icc_function_get_edges(function, CAPACITY, edges, kinds[0], &n, &n_tested),
                         ICC_OK);
        ck_assert_int_eq(
            icc_function_get_facets(function, CAPACITY, facets, kinds[1], &report, NULL, NULL),
            ICC_OK);
        ck_assert_uint_eq(report.n_tested, n_tested);
        ck_assert_uint_eq(report.n_compression + report.n_expansion, n);
        ck_assert(memcmp(facets, edges, 2 * n * sizeof *edges) == 0);
        ck_assert(memcmp(kinds[0], kinds[1], n * sizeof **kinds) == 0);
        icc_function_free(function);
    }
}
END_TEST

/* One line of vertices along the first axis, on which the function falls far below doubles. From
 * vertex to vertex the function has the same shape, so each step has the same facets. */
START_TEST(facets_beyond_doubles)
{
    enum { LENGTH = 900, N = LENGTH * 5 * 5, WINDOW = 10 };
    static uint8_t inside[N];
    static uint32_t facets[3 * 65536];
    static int32_t kinds[65536];
    const size_t shape[3] = {LENGTH, 5, 5};
    const icc_function_options options = {.size = sizeof options, .function = ICC_FUNCTION_LAPLACE};
    icc_facet_report report = {.size = sizeof report};
    icc_grid *grid;
    icc_tree *tree;
    icc_function *function;
    for (size_t v = 0; v < N; ++v)
        inside[v] = v / LENGTH == 12 && v % LENGTH > 1 && v % LENGTH < LENGTH - 2;
    const uint32_t root = 12 * LENGTH + 2;
    ck_assert_int_eq(icc_grid_create_mask(&grid, 3, shape, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&function, tree, &options, NULL, NULL), ICC_OK);
    ck_assert(icc_function_logs(function)[root + 800] < -1000);
    ck_assert_int_eq(icc_function_get_facets(function, 65536, facets, kinds, &report, NULL, NULL),
                     ICC_OK);
    const size_t n = report.n_compression + report.n_expansion;
    ck_assert(n < 65536);
    size_t count[LENGTH / WINDOW][3] = {{0}};
    for (size_t i = 0; i < n; ++i)
        ++count[facets[3 * i] % LENGTH / WINDOW][kinds[i]];
    for (size_t w = 3; w + 3 < LENGTH / WINDOW; ++w)
        for (int kind = 1; kind < 3; ++kind)
            ck_assert_uint_eq(count[w][kind], count[2][kind]);
    ck_assert(count[2][1] + count[2][2] > 0);
    icc_function_free(function);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

/* ---- curves ---- */

/* Starts a curve beside the middle of a facet. Returns true if it merges with others in the
 * facet. */
static bool merges(const icc_function *function, const icc_grid *grid, int32_t dim, const side *s,
                   int32_t way)
{
    const double NEAR = 1e-5;
    double corner[MOST_DIM * MOST_DIM], apex[MOST_DIM], point[MOST_DIM], *vertices;
    double length, alone, step = 0;
    size_t first[2];
    icc_curves *curves;
    icc_curves_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_points(grid, (size_t)dim, s->corner, corner), ICC_OK);
    ck_assert_int_eq(icc_grid_get_points(grid, 1, &s->apex, apex), ICC_OK);
    for (int32_t k = 0; k < dim; ++k) {
        double mean = 0;
        for (int32_t c = 0; c < dim; ++c)
            mean += corner[c * dim + k] / dim;
        point[k] = mean + NEAR * (apex[k] - mean);
    }
    ck_assert_int_eq(icc_curves_create(&curves, function, 1, point, way, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_curves_get_info(curves, &info), ICC_OK);
    vertices = malloc((size_t)dim * info.n_vertices * sizeof *vertices);
    ck_assert_int_eq(icc_curves_get_vertices(curves, first, vertices), ICC_OK);
    ck_assert_int_eq(icc_curves_get_ends(curves, NULL, &length, &alone, NULL, NULL), ICC_OK);
    ck_assert_uint_ge(info.n_vertices, 2);
    for (int32_t k = 0; k < dim; ++k) {
        const double d = vertices[dim + k] - vertices[k];
        step += d * d;
    }
    step = sqrt(step);
    ck_assert_double_lt(step, 1e-2); /* it has met the facet */
    free(vertices);
    icc_curves_free(curves);
    return alone < length && alone <= step * (1 + 1e-6);
}

/* Whoever comes to a facet stays in it if the other side's gradient does not lead on. That is so
 * for both sides at compression facets uphill, and at expansion facets downhill. */
START_TEST(curves_merge_at_these_facets)
{
    random_source r = {3};
    size_t n_merged[2] = {0}, n_parallel = 0, n_passed = 0;
    for (int round = 0; round < 60; ++round) {
        const int32_t dim = 2 + round % 3;
        icc_function *function = random_function(&r, dim, 9);
        const icc_grid *grid = icc_tree_grid(icc_function_tree(function));
        enumeration *e = enumerate(function);
        for (size_t k = 0; k < e->n; ++k) {
            if (!is_facet(e, k) || random_below(&r, 20) > 0)
                continue;
            for (int from = 0; from < 2; ++from) {
                const side *s = &e->sides[k + (size_t)from],
                           *other = &e->sides[k + 1 - (size_t)from];
                if (s->sign == 0)
                    continue;
                const int32_t way = s->sign < 0 ? ICC_WAY_UP : ICC_WAY_DOWN;
                const bool merged = merges(function, grid, dim, s, way);
                ck_assert_int_eq(merged, other->sign == 0 || other->sign == s->sign);
                n_merged[s->sign > 0] += merged && other->sign != 0;
                n_parallel += other->sign == 0;
                n_passed += !merged;
            }
        }
        free(e);
        icc_function_free(function);
    }
    ck_assert(n_merged[0] > 100 && n_merged[1] > 100 && n_parallel > 100 && n_passed > 100);
}
END_TEST

/* A curve that runs straight into a vertex is alone until there. */
START_TEST(curves_are_alone_until_the_first_vertex)
{
    for (int32_t dim = 2; dim <= 4; ++dim) {
        const size_t shape[MOST_DIM] = {5, 5, 5, 5};
        uint8_t inside[625];
        double values[625] = {0}, point[MOST_DIM], length, alone, step = 0;
        icc_curves *curves;
        uint32_t n = 1;
        for (int32_t k = 0; k < dim; ++k)
            n *= 5;
        for (uint32_t v = 0; v < n; ++v) {
            inside[v] = 1;
            for (uint32_t k = 0, rest = v; k < (uint32_t)dim; ++k, rest /= 5)
                values[v] += (1 << k) * (double)(rest % 5);
        }
        for (int32_t k = 0; k < dim; ++k) {
            point[k] = 2 - 0.03125 * (1 << k);
            step += (2 - point[k]) * (2 - point[k]);
        }
        icc_function *function = function_on(dim, shape, inside, n - 1, values);
        ck_assert_int_eq(icc_curves_create(&curves, function, 1, point, ICC_WAY_UP, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_curves_get_ends(curves, NULL, &length, &alone, NULL, NULL), ICC_OK);
        ck_assert_double_eq_tol(alone, sqrt(step), 1e-14);
        ck_assert_double_gt(length, 1);
        icc_curves_free(curves);
        icc_function_free(function);
    }
}
END_TEST

/* ---- charts and failures ---- */

/* A chart counts the facets of its function. */
START_TEST(charts_count_facets)
{
    for (int32_t dim = 2; dim <= MOST_DIM; ++dim) {
        const size_t shape[MOST_DIM] = {2, 1, 1, 1};
        const uint8_t cells[2] = {1, 1};
        const icc_chart_options options = {.size = sizeof options,
                                           .method = ICC_METHOD_GRADIENT,
                                           .function = ICC_FUNCTION_LAPLACE,
                                           .cells = dim < 4 ? 12 : 6};
        icc_domain *domain;
        icc_chart *chart;
        icc_gradient_info info = {.size = sizeof info};
        icc_facet_report report = {.size = sizeof report};
        ck_assert_int_eq(icc_domain_create_mask(&domain, dim, shape, cells, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_chart_get_gradient_info(chart, &info), ICC_OK);
        ck_assert_int_eq(
            icc_function_get_facets(icc_chart_function(chart), 0, NULL, NULL, &report, NULL, NULL),
            ICC_OK);
        ck_assert(report.n_compression > 0);
        ck_assert(info.n_edges == report.n_tested && info.n_compression == report.n_compression &&
                  info.n_expansion == report.n_expansion);
        icc_chart_free(chart);
        icc_domain_free(domain);
    }
}
END_TEST

static icc_status count(const icc_env *env, icc_error *err, void *function)
{
    icc_facet_report report = {.size = sizeof report};
    return icc_function_get_facets(function, 0, NULL, NULL, &report, env, err);
}

START_TEST(every_failure_is_reported)
{
    random_source r = {4};
    icc_function *function = random_function(&r, 3, 9);
    faulty_sweep(count, function);
    icc_facet_report report = {.size = sizeof report};
    icc_error err = {.size = sizeof err};
    uint32_t facet[3];
    int32_t kind;
    ck_assert_int_eq(icc_function_get_facets(NULL, 0, NULL, NULL, &report, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_get_facets(function, 0, NULL, NULL, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_get_facets(function, 1, NULL, &kind, &report, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(err.message, "facets"));
    ck_assert_int_eq(icc_function_get_facets(function, 1, facet, NULL, &report, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_ptr_nonnull(strstr(err.message, "kinds"));
    report.size = 0;
    ck_assert_int_eq(icc_function_get_facets(function, 0, NULL, NULL, &report, NULL, &err),
                     ICC_ERR_ARGUMENT);
    icc_function_free(function);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("facets");
    TCase *tests = tcase_create("facets");
    tcase_set_timeout(tests, 0);
    tcase_add_test(tests, facets_are_what_gradients_say);
    tcase_add_test(tests, facets_of_the_plane_are_its_edges);
    tcase_add_test(tests, facets_beyond_doubles);
    tcase_add_test(tests, curves_merge_at_these_facets);
    tcase_add_test(tests, curves_are_alone_until_the_first_vertex);
    tcase_add_test(tests, charts_count_facets);
    tcase_add_test(tests, every_failure_is_reported);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
