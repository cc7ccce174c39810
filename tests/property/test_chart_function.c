/* Charts of a function: those of icc_chart_create() are made again from the public stages, bit for
 * bit, and charts of a caller's stages are saved and loaded. */
#include "../faulty.h"
#include "../hard_masks.h"
#include "../meshes.h"
#include "../saved.h"
#include "../shape_domains.h"
#include "../suite.h"
#include "../surface_domains.h"

#include <icc/stages.h>

/* The stages of one chart. */
typedef struct stages {
    icc_grid *grid;
    icc_tree *tree;
    icc_function *function;
} stages;

static void stages_clear(stages *s)
{
    icc_function_free(s->function);
    icc_tree_free(s->tree);
    icc_grid_free(s->grid);
    *s = (stages){NULL, NULL, NULL};
}

/* The stages that the options of a chart name, from the root given or the one that they ask for. */
static stages stages_of(const icc_domain *domain, const icc_chart_options *o, uint32_t root)
{
    stages s;
    const icc_tree_options tree = {
        .size = sizeof tree, .form = o->tree, .axis_order = o->axis_order};
    const icc_function_options function = {.size = sizeof function,
                                           .function = o->function,
                                           .constraints = o->constraints,
                                           .solver = o->solver,
                                           .min_fall = o->min_fall,
                                           .leaf_min = o->leaf_min};
    ck_assert_int_eq(icc_grid_create(&s.grid, domain, o->cells, NULL, NULL), ICC_OK);
    if (root == UINT32_MAX)
        ck_assert_int_eq(o->maximum == NULL ? icc_grid_find_maximum(s.grid, &root, NULL, NULL, NULL)
                                            : icc_grid_find_nearest(s.grid, o->maximum, &root),
                         ICC_OK);
    ck_assert_int_eq(icc_tree_create(&s.tree, s.grid, root, &tree, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_function_create(&s.function, s.tree, &function, NULL, NULL), ICC_OK);
    return s;
}

static size_t n_vertices_of(const icc_grid *grid)
{
    icc_grid_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_grid_get_info(grid, &info), ICC_OK);
    return info.n_vertices;
}

static icc_chart *chart_of(const icc_domain *domain, const icc_chart_options *options)
{
    icc_chart *chart;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_chart_create(&chart, domain, options, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return chart;
}

static icc_chart *chart_from(const icc_function *function)
{
    icc_chart *chart;
    icc_error err = {.size = sizeof err};
    ck_assert_msg(icc_chart_create_function(&chart, function, NULL, &err) == ICC_OK, "%s",
                  err.message);
    return chart;
}

static void same_functions(const icc_function *a, const icc_function *b)
{
    icc_function_info x = {.size = sizeof x}, y = {.size = sizeof y};
    const size_t n = n_vertices_of(icc_tree_grid(icc_function_tree(a)));
    ck_assert_int_eq(icc_function_get_info(a, &x), ICC_OK);
    ck_assert_int_eq(icc_function_get_info(b, &y), ICC_OK);
    ck_assert_same(&x, &y, sizeof x, "info of the function");
    ck_assert_same(icc_function_values(a), icc_function_values(b), n * sizeof(double), "values");
    ck_assert((icc_function_logs(a) == NULL) == (icc_function_logs(b) == NULL));
    if (icc_function_logs(a) != NULL)
        ck_assert_same(icc_function_logs(a), icc_function_logs(b), n * sizeof(double), "logs");
    ck_assert_same(icc_tree_parents(icc_function_tree(a)), icc_tree_parents(icc_function_tree(b)),
                   n * sizeof(uint32_t), "parents");
}

/* Saves and loads a chart; takes it over. Returns the number of bytes. */
static size_t check_saved(icc_chart *chart)
{
    icc_chart *loaded;
    icc_error err = {.size = sizeof err};
    const icc_env threads = {.size = sizeof threads, .threads = 3};
    bytes b = chart_bytes(chart);
    ck_assert_msg(icc_chart_load(&loaded, b.n, b.data, &threads, &err) == ICC_OK, "%s",
                  err.message);
    same_chart(chart, loaded);
    same_functions(icc_chart_function(chart), icc_chart_function(loaded));
    bytes again = chart_bytes(loaded);
    ck_assert_uint_eq(again.n, b.n);
    ck_assert_same(again.data, b.data, b.n, "what is saved again");
    free(b.data);
    free(again.data);
    icc_chart_free(loaded);
    icc_chart_free(chart);
    return b.n;
}

/* ---- charts of options, made again ---- */

/* Makes a chart by its options and by its stages. A plate whose root moves is made from there. */
static void check_composition(const icc_domain *domain, const icc_chart_options *o)
{
    icc_chart *chart = chart_of(domain, o);
    const icc_function *function = icc_chart_function(chart);
    icc_gradient_info info = {.size = sizeof info};
    ck_assert_int_eq(icc_chart_get_gradient_info(chart, &info), ICC_OK);
    icc_chart_options made = *o;
    const bool moved = info.moved > 0;
    if (moved)
        made.constraints = ICC_CONSTRAINTS_NONE;
    stages s =
        stages_of(domain, &made, moved ? icc_tree_root(icc_function_tree(function)) : UINT32_MAX);
    icc_chart *again = chart_from(s.function);
    stages_clear(&s);
    same_functions(function, icc_chart_function(again));
    if (!moved)
        same_chart(chart, again);
    check_saved(again);
    icc_chart_free(chart);
}

static const int32_t FUNCTIONS[] = {ICC_FUNCTION_DECAY,     ICC_FUNCTION_DISTANCE,
                                    ICC_FUNCTION_LAPLACE,   ICC_FUNCTION_HARMONIC,
                                    ICC_FUNCTION_BILAPLACE, ICC_FUNCTION_CLAMPED};

START_TEST(polygons)
{
    for (int k = 0; k < N_SHAPES; ++k)
        for (int f = 0; f < 6; ++f) {
            const shape s = shape_number(k);
            const bool plate =
                FUNCTIONS[f] >= ICC_FUNCTION_BILAPLACE && FUNCTIONS[f] != ICC_FUNCTION_HARMONIC;
            const icc_chart_options o = {.size = sizeof o,
                                         .method = ICC_METHOD_GRADIENT,
                                         .function = FUNCTIONS[f],
                                         .tree = 1 + k % 2,
                                         .cells = plate ? 14 : 20 + k,
                                         .constraints = plate ? ICC_CONSTRAINTS_NONE : (k + f) % 4};
            icc_domain *domain = domain_of_shape(&s);
            check_composition(domain, &o);
            icc_domain_free(domain);
        }
}
END_TEST

START_TEST(options_of_all_kinds)
{
    static const double MAXIMUM[2] = {0.6, 2.2};
    static const int32_t ORDER[2] = {1, 0};
    const shape s = shape_l();
    icc_domain *domain = domain_of_shape(&s);
    for (int f = 0; f < 6; ++f) {
        const icc_chart_options o = {.size = sizeof o,
                                     .method = ICC_METHOD_GRADIENT,
                                     .function = FUNCTIONS[f],
                                     .tree = 1 + f % 2,
                                     .cells = 12,
                                     .maximum = MAXIMUM,
                                     .constraints = ICC_CONSTRAINTS_ALL,
                                     .solver = ICC_SOLVER_DIRECT,
                                     .min_fall = 1e-5,
                                     .leaf_min = 1e-8,
                                     .axis_order = f < 3 ? ORDER : NULL};
        check_composition(domain, &o);
    }
    icc_domain_free(domain);
}
END_TEST

static icc_domain *solid(int k)
{
    static surface s;
    random_source r = {3};
    icc_domain *domain;
    if (k == 0) {
        surface_octahedron(&s);
        surface_star(&s, 2, 0.3, &r);
        return domain_of_surface(&s);
    }
    if (k == 1) {
        test_mesh m = mesh_ball(3, 3, 0.1, &r);
        ck_assert_int_eq(mesh_domain(&domain, &m, NULL, NULL), ICC_OK);
        mesh_free(&m);
        return domain;
    }
    const int32_t dim = k == 5 ? 4 : 3;
    mask m = mask_draw(k == 2 ? mask_c : k == 3 ? mask_star : mask_l, dim, k == 5 ? 3 : 5);
    ck_assert_int_eq(icc_domain_create_mask(&domain, dim, m.shape, m.inside, NULL, NULL), ICC_OK);
    mask_free(&m);
    return domain;
}
enum { N_SOLIDS = 6 };

START_TEST(solids)
{
    for (int k = 0; k < N_SOLIDS; ++k)
        for (int f = 0; f < 4; ++f) {
            const icc_chart_options o = {.size = sizeof o,
                                         .method = ICC_METHOD_GRADIENT,
                                         .function = FUNCTIONS[f],
                                         .cells = k < 2 ? 14 : 0,
                                         .tree = 1 + (k + f) % 2};
            icc_domain *domain = solid(k);
            check_composition(domain, &o);
            icc_domain_free(domain);
        }
}
END_TEST

/* The caller's function stays as it was, and may be freed before its charts. */
START_TEST(functions_stay_as_they_are)
{
    const icc_chart_options o = {.size = sizeof o, .function = ICC_FUNCTION_LAPLACE, .cells = 14};
    icc_domain *domain = solid(0);
    stages s = stages_of(domain, &o, UINT32_MAX);
    const size_t n = n_vertices_of(s.grid) * sizeof(double);
    double *values = saved_alloc(n);
    memcpy(values, icc_function_values(s.function), n);
    icc_chart *charts[3] = {chart_from(s.function), chart_from(s.function), NULL};
    charts[2] = chart_from(icc_chart_function(charts[0]));
    ck_assert_same(values, icc_function_values(s.function), n, "values");
    ck_assert(memcmp(values, icc_function_values(icc_chart_function(charts[0])), n) != 0);
    stages_clear(&s);
    icc_domain_free(domain);
    same_chart(charts[0], charts[1]);
    same_chart(charts[0], charts[2]);
    for (int k = 0; k < 3; ++k)
        icc_chart_free(charts[k]);
    free(values);
}
END_TEST

/* ---- the order of the axes ---- */

START_TEST(axis_orders)
{
    static const int32_t ORDERS[2][3] = {{1, 0}, {2, 0, 1}}, USUAL[3] = {0, 1, 2};
    for (int k = 0; k < 2; ++k)
        for (int f = 0; f < 5; ++f) {
            const shape dart = shape_dart();
            icc_chart_options o = {.size = sizeof o,
                                   .method = ICC_METHOD_GRADIENT,
                                   .function = FUNCTIONS[f],
                                   .cells = k == 0 ? 20 : 10,
                                   .axis_order = ORDERS[k]};
            icc_domain *domain = k == 0 ? domain_of_shape(&dart) : solid(0);
            icc_chart *chart = chart_of(domain, &o);
            o.axis_order = NULL;
            icc_chart *usual = chart_of(domain, &o);
            const icc_tree *tree = icc_function_tree(icc_chart_function(chart));
            const icc_tree *other = icc_function_tree(icc_chart_function(usual));
            const size_t n = n_vertices_of(icc_tree_grid(tree)) * sizeof(uint32_t);
            ck_assert(memcmp(icc_tree_parents(tree), icc_tree_parents(other), n) != 0);
            check_saved(chart);

            /* The usual order is saved as if it had not been given. */
            o.axis_order = USUAL;
            chart = chart_of(domain, &o);
            bytes a = chart_bytes(chart), b = chart_bytes(usual);
            ck_assert(a.n == b.n && a.data[8] == 1);
            ck_assert_same(a.data, b.data, b.n, "bytes");
            free(a.data);
            free(b.data);
            icc_chart_free(chart);
            icc_chart_free(usual);
            icc_domain_free(domain);
        }
}
END_TEST

START_TEST(axis_orders_that_are_none_are_refused)
{
    static const int32_t BAD[4][2] = {{0, 0}, {1, 1}, {0, 2}, {-1, 0}};
    const shape s = shape_square();
    icc_domain *domain = domain_of_shape(&s);
    for (int k = 0; k < 4; ++k)
        for (int32_t method = 0; method <= ICC_METHOD_DISC; ++method) {
            const icc_chart_options o = {.size = sizeof o, .method = method, .axis_order = BAD[k]};
            icc_error err = {.size = sizeof err};
            icc_chart *chart;
            ck_assert_int_eq(icc_chart_create(&chart, domain, &o, NULL, &err), ICC_ERR_ARGUMENT);
            ck_assert(chart == NULL && err.item == ICC_ITEM_AXIS);
        }
    icc_domain_free(domain);
}
END_TEST

/* ---- stages of the caller's ---- */

enum { N_OWN = 7 };

/* Replaces parts of the stages by the caller's. */
static stages own_stages(const icc_domain *domain, int k, int32_t cells)
{
    const int32_t order[6] = {1, 0, 2, 3, 4, 5};
    const icc_chart_options o = {.size = sizeof o,
                                 .function = k % 2 == 0 ? ICC_FUNCTION_LAPLACE : ICC_FUNCTION_DECAY,
                                 .cells = cells,
                                 .axis_order = k == 6 ? order : NULL};
    stages s = stages_of(domain, &o, UINT32_MAX), own = {NULL, NULL, NULL};
    const size_t n = n_vertices_of(s.grid);
    const uint32_t root = icc_tree_root(s.tree);
    const double *f = icc_function_values(s.function), *logs = icc_function_logs(s.function);
    double *values = saved_alloc(n * sizeof *values);
    uint32_t *parents = saved_alloc(n * sizeof *parents);
    uint8_t *keep = saved_alloc(n);
    memcpy(parents, icc_tree_parents(s.tree), n * sizeof *parents);
    for (size_t v = 0; v < n; ++v) {
        const bool leaf = icc_tree_generations(s.tree)[v] > 4;
        keep[v] = !leaf || v % 5 != 0;
        values[v] = f[v] + (v % 7 == 0 ? 1e-3 : 0) * fabs(f[v]);
        if (k == 2 && !icc_grid_inside(s.grid)[v])
            values[v] = NAN;
        if (k == 3 || k == 4)
            values[v] = logs != NULL ? (k == 3 ? 1 : 300) * logs[v]
                                     : -(k == 3 ? 0.1 : 800) * icc_tree_generations(s.tree)[v];
    }
    if (k == 1 || k == 5) {
        icc_grid_free(own.grid);
        ck_assert_int_eq(icc_grid_restrict(&own.grid, s.grid, keep, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_tree_create(&own.tree, own.grid, root, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_function_create(&own.function, own.tree, NULL, NULL, NULL), ICC_OK);
    } else {
        ck_assert_int_eq(
            icc_tree_create_parents(&own.tree, s.grid, root, parents, NULL, NULL, NULL), ICC_OK);
        values[root] = k == 3 || k == 4 ? 1 : 2 * fabs(f[root]);
        ck_assert_int_eq(
            (k == 3 || k == 4)
                ? icc_function_create_logs(&own.function, own.tree, values, NULL, NULL)
                : icc_function_create_values(&own.function, own.tree, values, NULL, NULL),
            ICC_OK);
    }
    stages_clear(&s);
    free(values);
    free(parents);
    free(keep);
    return own;
}

START_TEST(own_stages_are_saved)
{
    for (int k = 0; k < N_OWN; ++k)
        for (int d = 0; d < 8; ++d) {
            const shape s = shape_number(d);
            icc_domain *domain = d < 4 ? domain_of_shape(&s) : solid(d - 4);
            stages own = own_stages(domain, k, d < 4 ? 20 : d < 6 ? 10 : 0);
            icc_chart *chart = chart_from(own.function);
            stages_clear(&own);
            icc_domain_free(domain);
            check_saved(chart);
        }
}
END_TEST

/* Where curves of the caller's function are known: they rise straight to the middle of a disc. */
START_TEST(a_cone_has_rays)
{
    enum { N = 40 };
    const double pi = 3.14159265358979323846, middle[2] = {0.1, -0.05};
    double xy[2 * N], points[2 * SAVED_POINTS], bary[2 * SAVED_POINTS], t[SAVED_POINTS];
    double back[2 * SAVED_POINTS];
    uint32_t facet[SAVED_POINTS], root;
    icc_status status[SAVED_POINTS];
    random_source r = {8};
    icc_grid_info info = {.size = sizeof info};
    stages s;
    for (int i = 0; i < N; ++i) {
        xy[2 * i] = cos(2 * pi * i / N);
        xy[2 * i + 1] = sin(2 * pi * i / N);
    }
    icc_domain *domain = domain_of_polygon(N, xy);
    ck_assert_int_eq(icc_grid_create(&s.grid, domain, 150, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_find_nearest(s.grid, middle, &root), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&s.tree, s.grid, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_grid_get_info(s.grid, &info), ICC_OK);
    double *at = saved_alloc(2 * info.n_vertices * sizeof *at), *values = at;
    ck_assert_int_eq(icc_grid_get_points(s.grid, info.n_vertices, NULL, at), ICC_OK);
    const double x = at[2 * root], y = at[2 * root + 1];
    for (size_t v = 0; v < info.n_vertices; ++v) {
        const double distance = hypot(at[2 * v] - x, at[2 * v + 1] - y);
        values[v] = -distance * distance;
    }
    ck_assert_int_eq(icc_function_create_values(&s.function, s.tree, values, NULL, NULL), ICC_OK);
    icc_chart *chart = chart_from(s.function);
    for (int i = 0; i < 2 * SAVED_POINTS; ++i)
        points[i] = random_between(&r, -0.6, 0.6);
    ck_assert_int_eq(
        icc_chart_encode(chart, SAVED_POINTS, points, facet, bary, t, status, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_chart_decode(chart, SAVED_POINTS, facet, bary, t, back, NULL, NULL, NULL),
                     ICC_OK);
    for (int i = 0; i < SAVED_POINTS; ++i) {
        const double dx = points[2 * i] - x, dy = points[2 * i + 1] - y, length = hypot(dx, dy);
        const size_t a = facet[i], b = (a + 1) % N;
        const double fx = bary[2 * i] * xy[2 * a] + bary[2 * i + 1] * xy[2 * b] - x;
        const double fy = bary[2 * i] * xy[2 * a + 1] + bary[2 * i + 1] * xy[2 * b + 1] - y;
        ck_assert_int_eq(status[i], ICC_OK);
        if (length < 0.2)
            continue;
        ck_assert_double_le(fabs(dx * fy - dy * fx) / (length * hypot(fx, fy)), 0.1);
        ck_assert_double_eq_tol(1 - t[i], length / hypot(fx, fy), 0.1);
        ck_assert_double_le(hypot(back[2 * i] - points[2 * i], back[2 * i + 1] - points[2 * i + 1]),
                            0.1);
    }
    free(values);
    stages_clear(&s);
    icc_domain_free(domain);
    check_saved(chart);
}
END_TEST

/* What is rebuilt takes no room: only the caller's numbers do. */
START_TEST(bytes_are_few)
{
    const shape l = shape_l();
    const icc_chart_options o = {.size = sizeof o, .function = ICC_FUNCTION_LAPLACE, .cells = 60};
    icc_domain *domain = domain_of_shape(&l);
    stages s = stages_of(domain, &o, UINT32_MAX);
    const size_t n = n_vertices_of(s.grid), plain = check_saved(chart_from(s.function));
    ck_assert_uint_le(plain, 400);
    uint8_t *keep = saved_alloc(n);
    memset(keep, 1, n);
    stages own = {NULL, NULL, NULL};
    ck_assert_int_eq(icc_grid_restrict(&own.grid, s.grid, keep, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create_parents(&own.tree, own.grid, icc_tree_root(s.tree),
                                             icc_tree_parents(s.tree), NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_int_eq(icc_function_create(&own.function, own.tree, NULL, NULL, NULL), ICC_OK);
    ck_assert_uint_le(check_saved(chart_from(own.function)), plain + n / 8 + n / 2 + 8);
    free(keep);
    stages_clear(&own);
    stages_clear(&s);
    icc_domain_free(domain);
}
END_TEST

/* ---- what is refused ---- */

static icc_error refused(const icc_function *function)
{
    icc_error err = {.size = sizeof err};
    icc_chart *chart;
    const icc_status status = icc_chart_create_function(&chart, function, NULL, &err);
    ck_assert(status != ICC_OK && chart == NULL && err.status == status && err.message[0] != '\0');
    return err;
}

START_TEST(grids_without_a_domain)
{
    const size_t sides[2] = {8, 8};
    uint8_t inside[64];
    const shape l = shape_l();
    const icc_chart_options o = {.size = sizeof o, .cells = 12};
    icc_domain *domain = domain_of_shape(&l);
    stages s = stages_of(domain, &o, UINT32_MAX), own = {NULL, NULL, NULL};
    for (int v = 0; v < 64; ++v)
        inside[v] = v % 8 > 1 && v % 8 < 6 && v / 8 > 1 && v / 8 < 6;
    for (int k = 0; k < 2; ++k) {
        uint32_t root;
        ck_assert_int_eq(k == 0 ? icc_grid_create_mask(&own.grid, 2, sides, inside, NULL, NULL)
                                : icc_grid_refine(&own.grid, s.grid, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_grid_find_maximum(own.grid, &root, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_tree_create(&own.tree, own.grid, root, NULL, NULL, NULL), ICC_OK);
        ck_assert_int_eq(icc_function_create(&own.function, own.tree, NULL, NULL, NULL), ICC_OK);
        const icc_error err = refused(own.function);
        ck_assert_int_eq(err.status, ICC_ERR_UNSUPPORTED);
        ck_assert_ptr_nonnull(strstr(err.message, k == 0 ? "mask of vertices" : "refined"));
        stages_clear(&own);
    }
    stages_clear(&s);
    icc_domain_free(domain);
}
END_TEST

START_TEST(roots_that_are_no_maximum)
{
    const shape l = shape_l();
    const icc_chart_options o = {.size = sizeof o, .cells = 12};
    icc_domain *domain = domain_of_shape(&l);
    stages s = stages_of(domain, &o, UINT32_MAX);
    const size_t n = n_vertices_of(s.grid);
    const uint32_t root = icc_tree_root(s.tree);
    double *values = saved_alloc(n * sizeof *values);
    memcpy(values, icc_function_values(s.function), n * sizeof *values);
    values[root + 1] = 2 * values[root];
    icc_function *own;
    ck_assert_int_eq(icc_function_create_values(&own, s.tree, values, NULL, NULL), ICC_OK);
    const icc_error err = refused(own);
    ck_assert_int_eq(err.status, ICC_ERR_ARGUMENT);
    ck_assert(err.item == ICC_ITEM_GRID_VERTEX && err.index == root + 1);
    icc_function_free(own);

    /* Farther away, a higher maximum is allowed. Its curves do not reach the root. */
    values[root + 1] = icc_function_values(s.function)[root + 1];
    uint32_t far = (uint32_t)n;
    while (!icc_grid_inside(s.grid)[--far])
        continue;
    values[far] = 2 * values[root];
    ck_assert_int_eq(icc_function_create_values(&own, s.tree, values, NULL, NULL), ICC_OK);
    check_saved(chart_from(own));
    icc_function_free(own);
    free(values);
    stages_clear(&s);
    icc_domain_free(domain);
    ck_assert_int_eq(refused(NULL).status, ICC_ERR_ARGUMENT);
}
END_TEST

/* ---- made-up bytes ---- */

/* One of each way to be saved by stages. */
static icc_chart *small_chart(int k)
{
    const shape l = shape_l();
    icc_domain *domain = k < N_OWN ? domain_of_shape(&l) : solid(4);
    stages own = own_stages(domain, k % N_OWN, k < N_OWN ? 8 : 0);
    icc_chart *chart = chart_from(own.function);
    stages_clear(&own);
    icc_domain_free(domain);
    return chart;
}

static icc_status load_chart(const bytes *b, icc_error *err)
{
    icc_chart *loaded;
    const icc_status status = icc_chart_load(&loaded, b->n, b->data, NULL, err);
    ck_assert((loaded != NULL) == (status == ICC_OK));
    icc_chart_free(loaded);
    return status;
}

START_TEST(damage_is_noticed)
{
    for (int k = 0; k < N_OWN; ++k) {
        icc_chart *chart = small_chart(k);
        bytes b = chart_bytes(chart);
        ck_assert_int_eq(b.data[8], 2);
        check_damage(&b, load_chart);
        b.data[8] = 1; /* the version */
        repair_bytes(&b, "CHRT");
        ck_assert_int_eq(load_chart(&b, NULL), ICC_ERR_FORMAT);
        free(b.data);
        icc_chart_free(chart);
    }
}
END_TEST

/* Whatever is loaded answers, and is saved as those bytes. */
START_TEST(content_is_checked)
{
    static coordinates c;
    random_source r = {6};
    int n_loaded = 0;
    for (int k = 0; k < N_OWN + 1; ++k) {
        icc_chart *chart = small_chart(k);
        bytes b = chart_bytes(chart), changed = {b.n, saved_alloc(b.n)};
        for (int i = 0; i < 500; ++i) {
            double points[SAVED_POINTS * ICC_MAX_DIM];
            icc_chart *loaded;
            make_up_content(&changed, &b, "CHRT", &r);
            const icc_status status = icc_chart_load(&loaded, changed.n, changed.data, NULL, NULL);
            ck_assert(status == ICC_OK || status == ICC_ERR_FORMAT || status == ICC_ERR_VERSION);
            if (status != ICC_OK)
                continue;
            saved_points(icc_chart_domain(loaded), 5, points);
            find_coordinates(loaded, points, &c);
            bytes again = chart_bytes(loaded);
            ck_assert_uint_eq(again.n, changed.n);
            ck_assert_same(again.data, changed.data, again.n, "what is saved again");
            free(again.data);
            icc_chart_free(loaded);
            ++n_loaded;
        }
        free(b.data);
        free(changed.data);
        icc_chart_free(chart);
    }
    ck_assert_int_gt(n_loaded, 0);
}
END_TEST

/* ---- maps ---- */

START_TEST(maps_of_such_charts)
{
    shape a, b;
    shape_pair(0, &a, &b);
    const icc_chart_options o = {.size = sizeof o, .method = ICC_METHOD_GRADIENT, .cells = 20};
    icc_domain *source = domain_of_shape(&a), *target = domain_of_shape(&b);
    stages own = own_stages(source, 3, 20);
    icc_chart *charts[3] = {chart_from(own.function), chart_of(target, &o), chart_of(source, &o)};
    for (int k = 0; k < 2; ++k) {
        icc_map *map, *loaded;
        ck_assert_int_eq(
            icc_map_create_from_charts(&map, charts[2 * k], charts[1], NULL, NULL, NULL), ICC_OK);
        bytes saved = map_bytes(map);
        ck_assert_int_eq(saved.data[8], k == 0 ? 3 : 1);
        ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_OK);
        same_map(map, loaded, source);
        icc_map_free(loaded);
        saved.data[8] = k == 0 ? 1 : 3;
        repair_bytes(&saved, "MAP_");
        ck_assert_int_eq(icc_map_load(&loaded, saved.n, saved.data, NULL, NULL), ICC_ERR_FORMAT);
        free(saved.data);
        icc_map_free(map);
    }
    for (int k = 0; k < 3; ++k)
        icc_chart_free(charts[k]);
    stages_clear(&own);
    icc_domain_free(source);
    icc_domain_free(target);
}
END_TEST

/* ---- failures ---- */

static icc_status make_chart(const icc_env *env, icc_error *err, void *argument)
{
    const stages *s = argument;
    icc_chart *chart;
    const icc_status status = icc_chart_create_function(&chart, s->function, env, err);
    ck_assert((chart != NULL) == (status == ICC_OK));
    icc_chart_free(chart);
    return status;
}

static icc_status read_chart(const icc_env *env, icc_error *err, void *argument)
{
    const bytes *b = argument;
    icc_chart *chart;
    const icc_status status = icc_chart_load(&chart, b->n, b->data, env, err);
    ck_assert((chart != NULL) == (status == ICC_OK));
    icc_chart_free(chart);
    return status;
}

START_TEST(failures)
{
    for (int k = 0; k < N_OWN + 1; ++k) {
        const shape l = shape_l();
        icc_domain *domain = k < N_OWN ? domain_of_shape(&l) : solid(4);
        stages own = own_stages(domain, k % N_OWN, k < N_OWN ? 8 : 0);
        icc_chart *chart = chart_from(own.function);
        bytes b = chart_bytes(chart);
        faulty_sweep(make_chart, &own);
        faulty_sweep(read_chart, &b);
        free(b.data);
        icc_chart_free(chart);
        stages_clear(&own);
        icc_domain_free(domain);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("charts of a function");
    TCase *tests = tcase_create("charts");
    tcase_add_test(tests, polygons);
    tcase_add_test(tests, options_of_all_kinds);
    tcase_add_test(tests, solids);
    tcase_add_test(tests, functions_stay_as_they_are);
    tcase_add_test(tests, axis_orders);
    tcase_add_test(tests, axis_orders_that_are_none_are_refused);
    tcase_add_test(tests, own_stages_are_saved);
    tcase_add_test(tests, a_cone_has_rays);
    tcase_add_test(tests, bytes_are_few);
    tcase_add_test(tests, grids_without_a_domain);
    tcase_add_test(tests, roots_that_are_no_maximum);
    tcase_add_test(tests, damage_is_noticed);
    tcase_add_test(tests, content_is_checked);
    tcase_add_test(tests, maps_of_such_charts);
    tcase_add_test(tests, failures);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
