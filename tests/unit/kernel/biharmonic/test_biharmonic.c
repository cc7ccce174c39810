/* Bounded biharmonic weights: the program of one weight, its limit for fine meshes, regions, and
 * what holds for the weights of handles. */
#include "../../../default_env.h"
#include "../../../handle_fixtures.h"
#include "../../../suite.h"
#include "kernel/biharmonic/biharmonic.h"
#include "kernel/biharmonic/bounded_program.h"

#include <math.h>
#include <string.h>

/* ---- the program ---- */

enum { N_FREE = 6, N_ROWS = N_FREE + 1 };

/* A dense matrix with a positive definite part, as iccp_symmetric has it. */
typedef struct dense {
    double entry[N_ROWS][N_ROWS], value[N_ROWS * N_ROWS], diagonal[N_ROWS];
    size_t first[N_ROWS + 1];
    uint32_t column[N_ROWS * N_ROWS];
} dense;

static iccp_symmetric random_matrix(dense *d, random_source *r)
{
    double root[N_ROWS][N_ROWS];
    size_t n = 0;
    for (size_t i = 0; i < N_ROWS; ++i)
        for (size_t j = 0; j < N_ROWS; ++j)
            root[i][j] = random_between(r, -1, 1);
    for (size_t i = 0; i < N_ROWS; ++i) {
        d->first[i] = n;
        for (size_t j = 0; j < N_ROWS; ++j) {
            d->entry[i][j] = i == j ? 0.001 : 0;
            for (size_t k = 0; k < N_ROWS; ++k)
                d->entry[i][j] += root[i][k] * root[j][k];
            if (i != j) {
                d->column[n] = (uint32_t)j;
                d->value[n++] = d->entry[i][j];
            }
        }
        d->diagonal[i] = d->entry[i][i];
    }
    d->first[N_ROWS] = n;
    return (iccp_symmetric){N_ROWS, d->first, d->column, d->value, d->diagonal};
}

/* The conditions of optimality. The forces are of size 1. */
static void check_optimal(const dense *d, const double *x)
{
    for (size_t i = 0; i < N_FREE; ++i) {
        double force = 0;
        for (size_t j = 0; j < N_ROWS; ++j)
            force += d->entry[i][j] * x[j];
        ck_assert(x[i] >= 0 && x[i] <= 1);
        ck_assert(x[i] < 1 || force < 1e-9);
        ck_assert(x[i] > 0 || force > -1e-9);
        ck_assert(x[i] == 0 || x[i] == 1 || fabs(force) < 1e-9);
    }
}

/* In some of these programs, changing all wrong values at once would go round in circles. */
START_TEST(a_program_is_solved_within_its_bounds)
{
    static const uint32_t ORDER[N_ROWS] = {3, 0, 6, 1, 5, 2, 4};
    bool held[N_ROWS] = {false};
    size_t n_low = 0, n_high = 0;
    random_source r = {5};
    held[N_FREE] = true;
    const iccp_env env = default_env();
    for (int trial = 0; trial < 3000; ++trial) {
        dense d;
        const iccp_symmetric matrix = random_matrix(&d, &r);
        const iccp_bounded program = {&matrix, ORDER, held};
        const double given = random_between(&r, 0.5, 2);
        double x[N_ROWS] = {0}, residual = 1;
        x[N_FREE] = given;
        ck_assert_int_eq(iccp_bounded_solve(&program, x, &residual, &env), ICC_OK);
        ck_assert_double_le(residual, 1e-9);
        ck_assert(x[N_FREE] == given);
        check_optimal(&d, x);
        for (size_t i = 0; i < N_FREE; ++i) {
            n_low += x[i] == 0;
            n_high += x[i] == 1;
        }
    }
    ck_assert_uint_gt(n_low, 1000);
    ck_assert_uint_gt(n_high, 1000);
}
END_TEST

START_TEST(an_indefinite_matrix_is_refused)
{
    static const size_t FIRST[3] = {0, 1, 2};
    static const uint32_t COLUMN[2] = {1, 0}, ORDER[2] = {0, 1};
    static const double VALUE[2] = {2, 2}, DIAGONAL[2] = {1, 1};
    static const bool HELD[2] = {false, false};
    const iccp_symmetric matrix = {2, FIRST, COLUMN, VALUE, DIAGONAL};
    const iccp_bounded program = {&matrix, ORDER, HELD};
    const iccp_env env = default_env();
    double x[2] = {0}, residual;
    ck_assert_int_eq(iccp_bounded_solve(&program, x, &residual, &env), ICC_ERR_SOLVER);
}
END_TEST

START_TEST(weights_are_shared_out)
{
    double some[3] = {3, -1, 1}, none[4] = {0, -1, 0, 0};
    ck_assert_int_eq(iccp_share_out(3, some), ICC_OK);
    ck_assert(some[0] == 0.75 && some[1] == 0 && some[2] == 0.25);
    ck_assert_int_eq(iccp_share_out(4, none), ICC_ERR_SOLVER);
    for (size_t j = 0; j < 4; ++j)
        ck_assert(none[j] == 0.25);
}
END_TEST

/* ---- the limit for fine meshes ---- */

static icc_shape *shape_of(size_t n, icc_domain *const *domains)
{
    icc_shape *shape;
    ck_assert_int_eq(icc_shape_create(&shape, 2, n, (const icc_domain *const *)domains, 0, NULL, 0,
                                      NULL, NULL, NULL),
                     ICC_OK);
    return shape;
}

static icc_domain *polygon(size_t n, const double *corners)
{
    icc_domain *domain;
    ck_assert_int_eq(icc_domain_create(&domain, 2, n, corners, 0, NULL, NULL, NULL), ICC_OK);
    return domain;
}

/* A strip with weights given at both ends. With no slope at the ends, the least energy has the cubic
 * polynomial t^2 (3 - 2 t). Returns the largest error with `cells` cells along the strip. */
static double strip_error(size_t cells)
{
    static const double STRIP[8] = {0, 0, 1, 0, 1, 0.25, 0, 0.25};
    const size_t across = cells / 4 + 1, n = (cells + 1) * across;
    icc_domain *domain = polygon(4, STRIP);
    icc_shape *shape = shape_of(1, &domain);
    double *nodes = allocate(n, 2 * sizeof *nodes), *weights = allocate(n, 2 * sizeof *weights);
    icc_status *status = allocate(n, sizeof *status);
    bool *held = allocate(n, sizeof *held);
    double worst = 0, residual = 1;
    for (size_t i = 0; i < n; ++i) {
        nodes[2 * i] = (double)(i / across) / (double)cells;
        nodes[2 * i + 1] = (double)(i % across) / (double)cells;
        held[i] = i < across || i >= n - across;
        weights[2 * i] = i < across;
        weights[2 * i + 1] = i >= n - across;
    }
    const iccp_biharmonic problem = {.shape = shape,
                                     .spacing = 1 / (double)cells,
                                     .n = n,
                                     .n_handles = 2,
                                     .nodes = nodes,
                                     .held = held};
    const iccp_env env = default_env();
    ck_assert_int_eq(iccp_biharmonic_solve(&problem, weights, status, &residual, &env, NULL),
                     ICC_OK);
    ck_assert_double_le(residual, 1e-9);
    for (size_t i = 0; i < n; ++i) {
        const double t = nodes[2 * i];
        worst = fmax(worst, fabs(weights[2 * i + 1] - t * t * (3 - 2 * t)));
        ck_assert_int_eq(status[i], ICC_OK);
    }
    free(nodes);
    free(weights);
    free(status);
    free(held);
    icc_shape_free(shape);
    icc_domain_free(domain);
    return worst;
}

START_TEST(a_finer_mesh_is_nearer_to_the_exact_solution)
{
    double error = strip_error(16);
    ck_assert_double_lt(error, 0.02);
    for (size_t cells = 32; cells <= 64; cells *= 2) {
        const double finer = strip_error(cells);
        ck_assert_double_lt(finer, 0.6 * error);
        error = finer;
    }
}
END_TEST

/* ---- regions ---- */

static const double INNER[12] = {0.2, 0.2, 0.8, 0.2, 0.8, 0.8, 0.6, 0.8, 0.6, 0.4, 0.2, 0.4};
static const double CORNERS[12] = {0.2, 0.2, 0.8, 0.2, 0.8, 0.8, 0.2, 0.4, 0.7, 0.6, 0.4, 0.3};

/* A grid of points on and inside INNER, and with `both` also around it. */
static icc_sampling *sample_angle(bool both)
{
    icc_domain *domains[2] = {polygon(6, INNER), polygon(4, SQUARE)};
    icc_shape *inner = shape_of(1, domains), *shape = shape_of(both ? 2 : 1, domains);
    double *points = allocate(2 * 21 * 21, sizeof *points);
    size_t n = 0;
    icc_sampling *sampling;
    for (int pass = 0; pass < 1 + both; ++pass)
        for (int i = 0; i <= 20; ++i)
            for (int k = 0; k <= 20; ++k) {
                const double place[2] = {i / 20.0, k / 20.0};
                icc_sampling *one;
                const bool inside =
                    icc_sampling_create_from_points(&one, inner, 1, place, NULL, NULL) == ICC_OK;
                icc_sampling_free(one);
                if (inside == (pass == 0))
                    memcpy(points + 2 * n++, place, sizeof place);
            }
    ck_assert_int_eq(icc_sampling_create_from_points(&sampling, shape, n, points, NULL, NULL),
                     ICC_OK);
    free(points);
    icc_shape_free(inner);
    icc_shape_free(shape);
    icc_domain_free(domains[0]);
    icc_domain_free(domains[1]);
    return sampling;
}

/* Weights take no short cut through the surroundings: those in the enclosed region are the same
 * without it. Around it they continue those on the wall. */
START_TEST(an_enclosed_region_comes_first)
{
    const icc_weights_options options = {.size = sizeof options, .method = ICC_WEIGHTS_BIHARMONIC};
    icc_sampling *alone = sample_angle(false), *both = sample_angle(true);
    icc_weights *a = make(alone, 6, CORNERS, &options), *b = make(both, 6, CORNERS, &options);
    const size_t n = info_of(a).n_nodes, n_both = info_of(b).n_nodes;
    double *of_a = weights_of(a), *of_b = weights_of(b), *points = nodes_of(b);
    ck_assert_uint_gt(n_both, n + 200);
    ck_assert(memcmp(of_a, of_b, 6 * n * sizeof *of_a) == 0);
    for (size_t i = n; i < n_both; ++i) {
        double sum = 0, nearest = HUGE_VAL, off = 0;
        for (size_t j = 0; j < 6; ++j) {
            ck_assert_double_ge(of_b[6 * i + j], 0);
            sum += of_b[6 * i + j];
        }
        ck_assert_double_eq_tol(sum, 1, 1e-14);
        for (size_t k = 0; k < n; ++k) {
            const double d =
                hypot(points[2 * i] - points[2 * k], points[2 * i + 1] - points[2 * k + 1]);
            if (d >= nearest)
                continue;
            nearest = d;
            off = 0;
            for (size_t j = 0; j < 6; ++j)
                off = fmax(off, fabs(of_b[6 * i + j] - of_b[6 * k + j]));
        }
        ck_assert(nearest > 0.051 || off < 0.3);
    }
    free(of_a);
    free(of_b);
    free(points);
    icc_weights_free(a);
    icc_weights_free(b);
    icc_sampling_free(alone);
    icc_sampling_free(both);
}
END_TEST

/* ---- weights of handles ---- */

static void check_weights(const icc_weights *weights, size_t m)
{
    const icc_weights_info info = info_of(weights);
    double *values = weights_of(weights);
    size_t n_zero = 0;
    ck_assert_int_eq(info.method, ICC_WEIGHTS_BIHARMONIC);
    ck_assert_uint_eq(info.n_infeasible, 0);
    for (size_t i = 0; i < info.n_nodes; ++i) {
        double sum = 0;
        for (size_t j = 0; j < m; ++j) {
            ck_assert(values[m * i + j] >= 0 && values[m * i + j] <= 1);
            ck_assert(i >= m || values[m * i + j] == (i == j));
            n_zero += values[m * i + j] == 0;
            sum += values[m * i + j];
        }
        ck_assert_double_eq_tol(sum, 1, 1e-14);
    }
    ck_assert_uint_gt(n_zero, info.n_nodes / 10);
    free(values);
}

/* For blue noise, grids that the walls cut, and fine outlines. */
START_TEST(weights_are_bounded_and_sum_to_one)
{
    static const double INSIDE[8] = {0.3, 0.3, 0.7, 0.35, 0.6, 0.7, 0.35, 0.6};
    double circle[400];
    for (size_t i = 0; i < 200; ++i) {
        circle[2 * i] = 0.5 + 0.47 * cos(0.031415926535897934 * (double)i);
        circle[2 * i + 1] = 0.5 + 0.47 * sin(0.031415926535897934 * (double)i);
    }
    for (int32_t kind = ICC_SAMPLING_GRID; kind <= ICC_SAMPLING_BLUE; ++kind) {
        icc_domain *domain = polygon(200, circle);
        icc_shape *shape = shape_of(1, &domain);
        icc_sampling *sampling;
        const icc_sampling_options spread = {
            .size = sizeof spread, .kind = kind, .spacing = 0.04, .steps = 10};
        ck_assert_int_eq(icc_sampling_create(&sampling, shape, &spread, NULL, NULL), ICC_OK);
        const icc_weights_options options = {.size = sizeof options,
                                             .method = ICC_WEIGHTS_BIHARMONIC};
        icc_weights *weights = make(sampling, 4, INSIDE, &options);
        check_weights(weights, 4);
        ck_assert_double_le(info_of(weights).residual, 1e-9);
        const icc_weights_report report = report_of(weights);
        ck_assert_double_le(report.lagrange, 1e-11);
        ck_assert_double_gt(report.reproduction, 0.01);
        icc_weights_free(weights);
        icc_sampling_free(sampling);
        icc_shape_free(shape);
        icc_domain_free(domain);
    }
}
END_TEST

START_TEST(edges_and_lines_are_linear)
{
    static const icc_line LINES[2] = {{.from = {0.2, 0.2}, .to = {0.6, 0.2}},
                                      {.from = {0.2, 0.4}, .to = {0.6, 0.4}, .parallel = 1}};
    icc_sampling *sampling = sample_square(0.05);
    const icc_weights_options options = {.size = sizeof options,
                                         .method = ICC_WEIGHTS_BIHARMONIC,
                                         .n_edges = 4,
                                         .edges = RING,
                                         .n_lines = 2,
                                         .lines = LINES};
    icc_weights *weights = make(sampling, 5, HANDLES, &options);
    double *values = weights_of(weights), *points = nodes_of(weights);
    size_t n_on_edge = 0, ends[2] = {0, 0}, n_between = 0;
    for (size_t i = 5; i < info_of(weights).n_nodes; ++i) {
        const double *x = points + 2 * i;
        if (x[1] <= 0) {
            ck_assert_double_eq_tol(values[5 * i], 1 - x[0], 1e-15);
            ck_assert_double_eq_tol(values[5 * i + 1], x[0], 1e-15);
            ++n_on_edge;
        }
        if (x[1] == 0.2 && (x[0] == 0.2 || x[0] == 0.6))
            ends[x[0] == 0.6] = i;
    }
    ck_assert_uint_gt(n_on_edge, 10);
    ck_assert(ends[0] > 0 && ends[1] > 0);
    for (size_t i = 5; i < info_of(weights).n_nodes; ++i) {
        const double *x = points + 2 * i, share = (x[0] - 0.2) / 0.4;
        if (x[1] != 0.2 || share <= 0 || share >= 1)
            continue;
        ++n_between;
        for (size_t j = 0; j < 5; ++j)
            ck_assert_double_eq_tol(
                values[5 * i + j],
                (1 - share) * values[5 * ends[0] + j] + share * values[5 * ends[1] + j], 1e-14);
    }
    ck_assert_uint_ge(n_between, 7);
    free(values);
    free(points);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

/* Painted weights are only shared out. Another method and back again gives the same bits. */
START_TEST(weights_can_be_painted_and_changed)
{
    static const double CENTRE[2] = {0.5, 0.4};
    icc_sampling *sampling = sample_square(0.05);
    const icc_weights_options options = {.size = sizeof options, .method = ICC_WEIGHTS_BIHARMONIC};
    icc_weights *weights = make(sampling, 5, HANDLES, &options), *painted, *other, *again;
    ck_assert_int_eq(icc_weights_paint(&painted, weights, 1, CENTRE, 0.2, -3, NULL, NULL), ICC_OK);
    check_weights(painted, 5);
    double value[5];
    ck_assert_int_eq(icc_weights_evaluate(painted, 1, CENTRE, value, NULL, NULL, NULL, NULL),
                     ICC_OK);
    ck_assert_double_lt(fabs(value[1]), 0.05);
    ck_assert_int_eq(icc_weights_with_method(&other, weights, ICC_WEIGHTS_QP, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_weights_with_method(&again, other, ICC_WEIGHTS_BIHARMONIC, NULL, NULL),
                     ICC_OK);
    double *a = weights_of(weights), *b = weights_of(again);
    ck_assert(memcmp(a, b, 5 * info_of(weights).n_nodes * sizeof *a) == 0);
    ck_assert(info_of(again).residual == info_of(weights).residual);
    ck_assert(info_of(other).residual == 0);
    free(a);
    free(b);
    icc_weights_free(weights);
    icc_weights_free(painted);
    icc_weights_free(other);
    icc_weights_free(again);
    icc_sampling_free(sampling);
}
END_TEST

/* ---- refusals ---- */

static void refuse(const icc_sampling *sampling, size_t n, const double *handles, icc_status status,
                   const char *message)
{
    const icc_weights_options options = {.size = sizeof options, .method = ICC_WEIGHTS_BIHARMONIC};
    icc_weights *weights = (icc_weights *)&weights;
    icc_error err = {.size = sizeof err};
    ck_assert_int_eq(icc_weights_create(&weights, sampling, n, handles, &options, NULL, &err),
                     status);
    ck_assert_ptr_null(weights);
    ck_assert_msg(strstr(err.message, message) != NULL, "%s", err.message);
}

START_TEST(other_shapes_are_refused)
{
    static const double AROUND[8] = {0.1, 0.1, 0.9, 0.1, 0.9, 0.9, 0.1, 0.9};
    static const double TIP[4] = {0.5, 0.5, 1.5, 0.5};
    static const uint32_t STICK[2] = {0, 1};
    icc_sampling *cube = sample_cube(), *both = sample_angle(true), *mixed;
    refuse(cube, 8, CUBE, ICC_ERR_UNSUPPORTED, "in the plane");
    refuse(both, 4, AROUND, ICC_ERR_ARGUMENT, "a handle in region 0");
    icc_domain *domain = polygon(4, SQUARE);
    const icc_domain *regions[1] = {domain};
    icc_shape *shape;
    const icc_sampling_options spread = {.size = sizeof spread, .spacing = 0.1};
    ck_assert_int_eq(icc_shape_create(&shape, 2, 1, regions, 2, TIP, 1, STICK, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_sampling_create(&mixed, shape, &spread, NULL, NULL), ICC_OK);
    refuse(mixed, 5, HANDLES, ICC_ERR_UNSUPPORTED, "on a curve");
    icc_sampling_free(cube);
    icc_sampling_free(both);
    icc_sampling_free(mixed);
    icc_shape_free(shape);
    icc_domain_free(domain);
}
END_TEST

START_TEST(rigid_parts_are_refused)
{
    static const uint32_t NODES[2] = {20, 21};
    icc_sampling *sampling = sample_square(0.1);
    const icc_weights_options options = {.size = sizeof options, .method = ICC_WEIGHTS_BIHARMONIC};
    icc_weights *weights = make(sampling, 5, HANDLES, &options), *stiff;
    ck_assert_int_eq(icc_weights_stiffen(&stiff, weights, 2, NODES, NULL, NULL, NULL, NULL),
                     ICC_ERR_UNSUPPORTED);
    ck_assert_ptr_null(stiff);
    icc_weights_free(weights);
    icc_sampling_free(sampling);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("biharmonic");
    TCase *tests = tcase_create("biharmonic");
    tcase_add_test(tests, a_program_is_solved_within_its_bounds);
    tcase_add_test(tests, an_indefinite_matrix_is_refused);
    tcase_add_test(tests, weights_are_shared_out);
    tcase_add_test(tests, a_finer_mesh_is_nearer_to_the_exact_solution);
    tcase_add_test(tests, an_enclosed_region_comes_first);
    tcase_add_test(tests, weights_are_bounded_and_sum_to_one);
    tcase_add_test(tests, edges_and_lines_are_linear);
    tcase_add_test(tests, weights_can_be_painted_and_changed);
    tcase_add_test(tests, other_shapes_are_refused);
    tcase_add_test(tests, rigid_parts_are_refused);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
