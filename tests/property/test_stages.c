/* The papers' stages by public calls alone: a caller's tree, a caller's function, and its integral
 * curves give what charts of method gradient give. */
#include "../faulty.h"
#include "../random.h"
#include "../shapes.h"
#include "../suite.h"

#include <icc/stages.h>
#include <math.h>
#include <string.h>

enum { N_POINTS = 200 };

static const int32_t FUNCTIONS[] = {ICC_FUNCTION_DECAY, ICC_FUNCTION_DISTANCE, ICC_FUNCTION_LAPLACE,
                                    ICC_FUNCTION_HARMONIC};

/* The stages of one shape. */
typedef struct stages {
    icc_domain *domain;
    icc_grid *grid;
    uint32_t root;
    icc_tree *tree;
    icc_function *function;
} stages;

static void stages_init(stages *s, const shape *of, int32_t function)
{
    const icc_function_options options = {.size = sizeof options, .function = function};
    ck_assert_int_eq(icc_domain_create(&s->domain, 2, of->n, of->xy, 0, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_create(&s->grid, s->domain, 30, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_maximum(s->grid, &s->root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&s->tree, s->grid, s->root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&s->function, s->tree, &options, NULL, NULL), ICC_OK);
}

static void stages_clear(stages *s)
{
    icc_function_free(s->function);
    icc_tree_free(s->tree);
    icc_grid_free(s->grid);
    icc_domain_free(s->domain);
}

static shape polygon(int k)
{
    return k == 0   ? shape_l()
           : k == 1 ? shape_e()
           : k == 2 ? shape_star(5, 0.5, 0.3)
                    : shape_dart();
}

static size_t n_vertices_of(const icc_grid *grid)
{
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    return info.n_vertices;
}

static void random_inside(random_source *r, const icc_domain *domain, double *points)
{
    icc_domain_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_domain_get_info(domain, &info), ICC_OK);
    for (size_t n = 0; n < N_POINTS;) {
        int32_t where;
        for (int k = 0; k < info.dim; ++k)
            points[n * (size_t)info.dim + (size_t)k] =
                random_between(r, info.lower[k], info.upper[k]);
        ck_assert_int_eq(
            icc_domain_locate(domain, 1, points + n * (size_t)info.dim, &where, NULL, NULL, NULL),
            ICC_OK);
        n += where == ICC_INSIDE;
    }
}

/* How curves end. */
typedef struct ends {
    int32_t end[N_POINTS];
    double length[N_POINTS], alone[N_POINTS], bary[3 * N_POINTS];
    uint32_t facet[N_POINTS];
} ends;

static icc_curves *curves_of(const icc_function *function, const double *points, int32_t way,
                             ends *e)
{
    icc_curves *curves;
    ck_assert_int_eq(icc_curves_create(&curves, function, N_POINTS, points, way, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_curves_get_ends(curves, e->end, e->length, e->alone, e->facet, e->bary),
                     ICC_OK);
    return curves;
}

/* ---- curves ---- */

/* Coordinates are where the curve down ends, and the share of its length. */
START_TEST(curves_give_the_coordinates_of_charts)
{
    random_source r = {1};
    for (int k = 0; k < 16; ++k) {
        const shape of = polygon(k % 4);
        const int32_t function = FUNCTIONS[k / 4];
        double points[2 * N_POINTS], bary[2 * N_POINTS], t[N_POINTS];
        uint32_t facet[N_POINTS];
        icc_status status[N_POINTS];
        const icc_chart_options options = {.size = sizeof options,
                                           .method = ICC_METHOD_GRADIENT,
                                           .function = function,
                                           .cells = 30};
        ends down, up;
        stages s;
        icc_chart *chart;
        stages_init(&s, &of, function);
        random_inside(&r, s.domain, points);
        ck_assert_int_eq(icc_chart_create(&chart, s.domain, &options, NULL, NULL), ICC_OK);
        ck_assert_int_eq(
            icc_chart_encode(chart, N_POINTS, points, facet, bary, t, status, NULL, NULL), ICC_OK);
        icc_curves_free(curves_of(s.function, points, ICC_WAY_DOWN, &down));
        icc_curves_free(curves_of(s.function, points, ICC_WAY_UP, &up));
        for (size_t i = 0; i < N_POINTS; ++i) {
            ck_assert_int_eq(down.end[i] == ICC_END_BOUNDARY && up.end[i] == ICC_END_MAXIMUM,
                             status[i] == ICC_OK);
            if (status[i] != ICC_OK)
                continue;
            ck_assert_uint_eq(down.facet[i], facet[i]);
            ck_assert(memcmp(down.bary + 2 * i, bary + 2 * i, 2 * sizeof *bary) == 0);
            ck_assert_double_eq_tol(down.length[i] / (down.length[i] + up.length[i]), t[i], 1e-14);
            ck_assert(down.alone[i] <= down.length[i] && up.alone[i] <= up.length[i]);
            ck_assert_uint_eq(up.facet[i], UINT32_MAX);
        }
        icc_chart_free(chart);
        stages_clear(&s);
    }
}
END_TEST

/* f rises along a curve, which begins at its point; its length is the sum of its pieces. */
START_TEST(curves_are_polylines_of_their_length)
{
    random_source r = {2};
    for (int way = ICC_WAY_UP; way <= ICC_WAY_DOWN; ++way) {
        double points[2 * N_POINTS];
        const shape of = shape_l();
        icc_curves_info info = {.size = sizeof info};
        size_t first[N_POINTS + 1], n_merged = 0;
        stages s;
        ends e;
        stages_init(&s, &of, ICC_FUNCTION_LAPLACE);
        random_inside(&r, s.domain, points);
        icc_curves *curves = curves_of(s.function, points, way, &e);
        ck_assert_int_eq(icc_curves_get_info(curves, &info), ICC_OK);
        ck_assert(info.dim == 2 && info.way == way && info.n_curves == N_POINTS);
        double *xy = malloc(2 * info.n_vertices * sizeof *xy);
        ck_assert_int_eq(icc_curves_get_vertices(curves, first, xy), ICC_OK);
        ck_assert_uint_eq(first[N_POINTS], info.n_vertices);
        for (size_t i = 0; i < N_POINTS; ++i) {
            double length = 0;
            ck_assert_double_eq_tol(xy[2 * first[i]], points[2 * i], 1e-14);
            for (size_t k = first[i] + 1; k < first[i + 1]; ++k)
                length += hypot(xy[2 * k] - xy[2 * k - 2], xy[2 * k + 1] - xy[2 * k - 1]);
            ck_assert_double_eq_tol(length, e.length[i], 1e-12);
            n_merged += e.alone[i] < e.length[i];
        }
        ck_assert_uint_eq(n_merged, info.n_merged);
        free(xy);
        icc_curves_free(curves);
        stages_clear(&s);
    }
}
END_TEST

/* The same bits for any number of threads, and no curve for points outside. */
START_TEST(curves_of_points_anywhere)
{
    const double points[6] = {-9, 0.5, 0, 0.5, 0.5, 0.5};
    const shape of = shape_square();
    int32_t end[3];
    double length[3];
    uint32_t facet[3];
    size_t first[4];
    stages s;
    icc_curves *curves;
    stages_init(&s, &of, ICC_FUNCTION_DISTANCE);
    ck_assert_int_eq(icc_curves_create(&curves, s.function, 3, points, ICC_WAY_DOWN, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_curves_get_ends(curves, end, length, NULL, facet, NULL), ICC_OK);
    ck_assert_int_eq(icc_curves_get_vertices(curves, first, NULL), ICC_OK);
    ck_assert(end[0] == ICC_END_NONE && first[1] == 0 && facet[0] == UINT32_MAX);
    ck_assert(end[1] == ICC_END_BOUNDARY && first[2] == 1 && facet[1] == 3);
    ck_assert(end[2] == ICC_END_BOUNDARY && length[2] >= 0.5 - 1e-12);
    icc_curves_free(curves);
    ck_assert_int_eq(icc_curves_create(&curves, s.function, 0, NULL, ICC_WAY_UP, NULL, NULL),
                     ICC_OK);
    icc_curves_free(curves);
    stages_clear(&s);
}
END_TEST

/* A plane over a mask: curves are straight, and end where the values do. No other curve joins them,
 * except along the last edges that have values. */
START_TEST(curves_of_a_plane_stay_alone)
{
    random_source r = {7};
    for (int32_t dim = 2; dim <= 3; ++dim) {
        const size_t side = 9, sides[3] = {side, side, side};
        const size_t n = dim == 2 ? side * side : side * side * side;
        double *values = malloc(n * sizeof *values), *xyz = malloc((size_t)dim * n * sizeof *xyz);
        uint8_t *inside = calloc(n, 1);
        double points[3 * N_POINTS];
        uint32_t root = 0;
        size_t n_alone = 0;
        icc_grid *grid;
        icc_tree *tree;
        icc_function *function;
        ends e;
        for (size_t v = 0; v < n; ++v) {
            inside[v] = 1;
            for (size_t k = v, axis = 0; axis < (size_t)dim; k /= side, ++axis)
                inside[v] = inside[v] && k % side > 1 && k % side < side - 2;
            root = inside[v] ? (uint32_t)v : root;
        }
        ck_assert_int_eq(icc_grid_create_mask(&grid, dim, sides, inside, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_grid_get_points(grid, n, NULL, xyz), ICC_OK);
        for (size_t v = 0; v < n; ++v)
            for (int k = (int)(values[v] = 0); k < dim; ++k)
                values[v] += (1 + 0.37 * k) * xyz[(size_t)dim * v + (size_t)k];
        ck_assert_int_eq(icc_tree_create(&tree, grid, root, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_function_create_values(&function, tree, values, NULL, NULL), ICC_OK);
        for (size_t i = 0; i < (size_t)dim * N_POINTS; ++i)
            points[i] = random_between(&r, 2.1, 5.9);
        icc_curves_free(curves_of(function, points, ICC_WAY_DOWN, &e));
        for (size_t i = 0; i < N_POINTS; ++i) {
            ck_assert_int_eq(e.end[i], ICC_END_VALUES);
            ck_assert(e.alone[i] > 0 && e.alone[i] <= e.length[i]);
            n_alone += e.alone[i] >= e.length[i];
        }
        ck_assert_uint_ge(n_alone, N_POINTS / 2);
        icc_function_free(function);
        icc_tree_free(tree);
        icc_grid_free(grid);
        free(values);
        free(xyz);
        free(inside);
    }
}
END_TEST

/* ---- trees ---- */

START_TEST(a_tree_is_made_again_from_its_parents)
{
    for (int k = 0; k < 4; ++k) {
        const shape of = polygon(k);
        stages s;
        icc_tree *again;
        stages_init(&s, &of, ICC_FUNCTION_DECAY);
        const size_t n = n_vertices_of(s.grid);
        ck_assert_int_eq(icc_tree_create_parents(&again, s.grid, s.root, icc_tree_parents(s.tree),
                                                 NULL, NULL, NULL),
                         ICC_OK);
        ck_assert(memcmp(icc_tree_parents(again), icc_tree_parents(s.tree), n * sizeof(uint32_t)) ==
                  0);
        ck_assert(memcmp(icc_tree_generations(again), icc_tree_generations(s.tree),
                         n * sizeof(int32_t)) == 0);
        icc_tree_free(again);
        stages_clear(&s);
    }
}
END_TEST

static icc_status make_tree(const stages *s, const uint32_t *parents, int64_t *index)
{
    icc_error err = {.size = sizeof err};
    icc_tree *tree;
    const icc_status status =
        icc_tree_create_parents(&tree, s->grid, s->root, parents, NULL, NULL, &err);
    *index = err.index;
    ck_assert(status == ICC_OK || (tree == NULL && err.message[0] != '\0'));
    icc_tree_free(tree);
    return status;
}

START_TEST(parents_that_are_none_are_refused)
{
    const shape of = shape_l();
    stages s;
    int64_t index;
    stages_init(&s, &of, ICC_FUNCTION_DECAY);
    const size_t n = n_vertices_of(s.grid);
    uint32_t *parents = malloc(n * sizeof *parents);
    memcpy(parents, icc_tree_parents(s.tree), n * sizeof *parents);
    uint32_t child = 0;
    while (parents[child] != s.root)
        ++child;

    parents[s.root] = child;
    ck_assert_int_eq(make_tree(&s, parents, &index), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(index, s.root);
    parents[s.root] = UINT32_MAX;

    parents[child] = child; /* a cycle */
    ck_assert_int_eq(make_tree(&s, parents, &index), ICC_ERR_ARGUMENT);
    parents[child] = (uint32_t)n; /* no vertex */
    ck_assert_int_eq(make_tree(&s, parents, &index), ICC_ERR_ARGUMENT);
    parents[child] = UINT32_MAX; /* left out, but it has children */
    ck_assert_int_eq(make_tree(&s, parents, &index), ICC_ERR_ARGUMENT);

    for (size_t v = 0; v < n; ++v) /* the root alone */
        parents[v] = UINT32_MAX;
    ck_assert_int_eq(make_tree(&s, parents, &index), ICC_OK);
    free(parents);
    stages_clear(&s);
}
END_TEST

/* ---- functions ---- */

/* With all values given, outside as well, curves are the same to the bit. */
START_TEST(values_of_a_function_give_its_curves)
{
    random_source r = {3};
    for (int k = 0; k < 16; ++k) {
        const shape of = polygon(k % 4);
        double points[2 * N_POINTS];
        ends given, own;
        stages s;
        icc_function *again;
        icc_function_info info = {.size = sizeof info};
        stages_init(&s, &of, FUNCTIONS[k / 4]);
        random_inside(&r, s.domain, points);
        ck_assert_int_eq(
            icc_function_create_values(&again, s.tree, icc_function_values(s.function), NULL, NULL),
            ICC_OK);
        ck_assert_int_eq(icc_function_get_info(again, &info), ICC_OK);
        ck_assert_int_eq(info.function, ICC_FUNCTION_VALUES);
        ck_assert_uint_eq(info.highest, s.root);
        memset(&given, 0, sizeof given);
        memset(&own, 0, sizeof own);
        icc_curves_free(curves_of(again, points, ICC_WAY_DOWN, &given));
        icc_curves_free(curves_of(s.function, points, ICC_WAY_DOWN, &own));
        ck_assert(memcmp(&given, &own, sizeof own) == 0);
        icc_function_free(again);
        stages_clear(&s);
    }
}
END_TEST

/* Values inside alone: the function goes on outside, and as many curves meet the boundary. */
START_TEST(values_inside_go_on_outside)
{
    random_source r = {4};
    for (int k = 0; k < 4; ++k) {
        const shape of = polygon(k);
        double points[2 * N_POINTS];
        size_t n_met = 0, n_own = 0;
        ends e;
        stages s;
        icc_function *function;
        stages_init(&s, &of, ICC_FUNCTION_DISTANCE);
        random_inside(&r, s.domain, points);
        const size_t n = n_vertices_of(s.grid);
        double *values = malloc(n * sizeof *values);
        for (size_t v = 0; v < n; ++v)
            values[v] = icc_grid_inside(s.grid)[v] ? icc_function_values(s.function)[v] : NAN;
        ck_assert_int_eq(icc_function_create_values(&function, s.tree, values, NULL, NULL), ICC_OK);
        icc_curves_free(curves_of(function, points, ICC_WAY_DOWN, &e));
        for (size_t i = 0; i < N_POINTS; ++i)
            n_met += e.end[i] == ICC_END_BOUNDARY;
        icc_curves_free(curves_of(s.function, points, ICC_WAY_DOWN, &e));
        for (size_t i = 0; i < N_POINTS; ++i)
            n_own += e.end[i] == ICC_END_BOUNDARY;
        ck_assert_uint_ge(n_met, n_own);
        icc_function_free(function);
        values[s.root] = NAN;
        icc_error err = {.size = sizeof err};
        ck_assert_int_eq(icc_function_create_values(&function, s.tree, values, NULL, &err),
                         ICC_ERR_ARGUMENT);
        ck_assert_int_eq(err.index, s.root);
        free(values);
        stages_clear(&s);
    }
}
END_TEST

/* Two peaks: curves end at both, and the report counts them. */
START_TEST(a_second_maximum_ends_curves)
{
    random_source r = {5};
    double points[2 * N_POINTS];
    size_t n_ends[5] = {0};
    const shape of = shape_l();
    ends e;
    stages s;
    icc_function *function;
    icc_function_report report = {.size = sizeof report};
    stages_init(&s, &of, ICC_FUNCTION_DECAY);
    random_inside(&r, s.domain, points);
    const size_t n = n_vertices_of(s.grid);
    double *xy = malloc(2 * n * sizeof *xy), *values = malloc(n * sizeof *values);
    ck_assert_int_eq(icc_grid_get_points(s.grid, n, NULL, xy), ICC_OK);
    for (size_t v = 0; v < n; ++v)
        values[v] = -fmin(hypot(xy[2 * v] - 2.5, xy[2 * v + 1] - 0.5),
                          hypot(xy[2 * v] - 0.5, xy[2 * v + 1] - 2.5));
    ck_assert_int_eq(icc_function_create_values(&function, s.tree, values, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_get_report(function, &report, NULL, NULL), ICC_OK);
    ck_assert_uint_eq(report.n_maxima, 2);
    icc_curves_free(curves_of(function, points, ICC_WAY_UP, &e));
    for (size_t i = 0; i < N_POINTS; ++i)
        ++n_ends[e.end[i]];
    ck_assert_uint_eq(n_ends[ICC_END_CRITICAL], N_POINTS);
    icc_function_free(function);
    free(xy);
    free(values);
    stages_clear(&s);
}
END_TEST

START_TEST(logarithms_of_a_function_give_it_again)
{
    const shape of = shape_e();
    stages s;
    icc_function *again;
    stages_init(&s, &of, ICC_FUNCTION_LAPLACE);
    const double *logs = icc_function_logs(s.function);
    ck_assert_int_eq(icc_function_create_logs(&again, s.tree, logs, NULL, NULL), ICC_OK);
    for (size_t v = 0; v < n_vertices_of(s.grid); ++v) {
        const double was = icc_function_values(s.function)[v], is = icc_function_values(again)[v];
        ck_assert_int_eq(isnan(was) != 0, isnan(is) != 0);
        if (!isnan(was))
            ck_assert_double_le(fabs(is - was), 1e-12 * fabs(was));
        if (isfinite(logs[v]))
            ck_assert_double_eq_tol(icc_function_logs(again)[v], logs[v], 1e-12);
    }
    icc_function_free(again);
    stages_clear(&s);
}
END_TEST

/* Far below what doubles hold. */
START_TEST(logarithms_may_be_far_below_doubles)
{
    const size_t sides[2] = {400, 3};
    static uint8_t inside[1200];
    static double logs[1200];
    icc_grid *grid;
    icc_tree *tree;
    icc_function *function;
    icc_curves *curves;
    int32_t end;
    const double point[2] = {350.3, 1.0};
    for (size_t v = 0; v < 1200; ++v) {
        inside[v] = v / 400 == 1 && v % 400 > 0 && v % 400 < 399;
        logs[v] = -40.0 * (double)(v % 400);
    }
    ck_assert_int_eq(icc_grid_create_mask(&grid, 2, sides, inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&tree, grid, 401, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create_logs(&function, tree, logs, NULL, NULL), ICC_OK);
    ck_assert_double_eq_tol(icc_function_logs(function)[700], logs[700], 1e-8);
    ck_assert_int_eq(icc_curves_create(&curves, function, 1, point, ICC_WAY_UP, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_curves_get_ends(curves, &end, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(end, ICC_END_MAXIMUM);
    icc_curves_free(curves);
    ck_assert_int_eq(icc_curves_create(&curves, function, 1, point, ICC_WAY_DOWN, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_curves_get_ends(curves, &end, NULL, NULL, NULL, NULL), ICC_OK);
    ck_assert(end == ICC_END_VALUES || end == ICC_END_CRITICAL); /* a mask has no boundary */
    icc_curves_free(curves);
    icc_function_free(function);
    icc_tree_free(tree);
    icc_grid_free(grid);
}
END_TEST

/* ---- space ---- */

/* A box as a mask of cells: curves down and up give the chart's coordinates here, too. */
START_TEST(curves_in_space_give_the_coordinates_of_charts)
{
    random_source r = {6};
    const size_t sides[3] = {2, 1, 1};
    const uint8_t cells[2] = {1, 1};
    double points[3 * N_POINTS], bary[3 * N_POINTS], t[N_POINTS];
    uint32_t facet[N_POINTS];
    icc_status status[N_POINTS];
    const icc_chart_options options = {.size = sizeof options,
                                       .method = ICC_METHOD_GRADIENT,
                                       .function = ICC_FUNCTION_LAPLACE,
                                       .cells = 12};
    ends down, up;
    icc_domain *domain;
    icc_chart *chart;
    ck_assert_int_eq(icc_domain_create_mask(&domain, 3, sides, cells, NULL, NULL), ICC_OK);
    random_inside(&r, domain, points);
    ck_assert_int_eq(icc_chart_create(&chart, domain, &options, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_encode(chart, N_POINTS, points, facet, bary, t, status, NULL, NULL),
                     ICC_OK);
    icc_curves_free(curves_of(icc_chart_function(chart), points, ICC_WAY_DOWN, &down));
    icc_curves_free(curves_of(icc_chart_function(chart), points, ICC_WAY_UP, &up));
    for (size_t i = 0; i < N_POINTS; ++i) {
        ck_assert_int_eq(status[i], ICC_OK);
        ck_assert_uint_eq(down.facet[i], facet[i]);
        ck_assert(memcmp(down.bary + 3 * i, bary + 3 * i, 3 * sizeof *bary) == 0);
        ck_assert_double_eq_tol(down.length[i] / (down.length[i] + up.length[i]), t[i], 1e-14);
    }
    icc_chart_free(chart);
    icc_domain_free(domain);
}
END_TEST

/* ---- failures ---- */

static icc_status make_curves(const icc_env *env, icc_error *err, void *argument)
{
    const stages *s = argument;
    const double points[4] = {0.5, 0.5, 0.5, 2};
    icc_tree *tree = NULL;
    icc_function *function = NULL, *logs = NULL;
    icc_curves *curves = NULL;
    icc_status status =
        icc_tree_create_parents(&tree, s->grid, s->root, icc_tree_parents(s->tree), NULL, env, err);
    if (status == ICC_OK)
        status =
            icc_function_create_values(&function, tree, icc_function_values(s->function), env, err);
    if (status == ICC_OK)
        status = icc_function_create_logs(&logs, tree, icc_function_logs(s->function), env, err);
    if (status == ICC_OK)
        status = icc_curves_create(&curves, function, 2, points, ICC_WAY_UP, env, err);
    icc_curves_free(curves);
    icc_function_free(logs);
    icc_function_free(function);
    icc_tree_free(tree);
    return status;
}

START_TEST(every_allocation_may_fail)
{
    const shape of = shape_l();
    stages s;
    stages_init(&s, &of, ICC_FUNCTION_LAPLACE);
    faulty_sweep(make_curves, &s);
    stages_clear(&s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("stages");
    TCase *tests = tcase_create("stages");
    tcase_set_timeout(tests, 0);
    tcase_add_test(tests, curves_give_the_coordinates_of_charts);
    tcase_add_test(tests, curves_are_polylines_of_their_length);
    tcase_add_test(tests, curves_of_points_anywhere);
    tcase_add_test(tests, curves_of_a_plane_stay_alone);
    tcase_add_test(tests, a_tree_is_made_again_from_its_parents);
    tcase_add_test(tests, parents_that_are_none_are_refused);
    tcase_add_test(tests, values_of_a_function_give_its_curves);
    tcase_add_test(tests, values_inside_go_on_outside);
    tcase_add_test(tests, a_second_maximum_ends_curves);
    tcase_add_test(tests, logarithms_of_a_function_give_it_again);
    tcase_add_test(tests, logarithms_may_be_far_below_doubles);
    tcase_add_test(tests, curves_in_space_give_the_coordinates_of_charts);
    tcase_add_test(tests, every_allocation_may_fail);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
