/* Weights of single points: every method against what defines its solution. */
#include "kernel/weights/dual.h"
#include "kernel/weights/rigid_parts.h"
#include "kernel/weights/weights.h"

#include "../../../random.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 64 };

/* Handles, a point and where its weights start from. */
typedef struct problem {
    size_t dim, m;
    double handles[3 * MOST], point[3], start[MOST], weights[MOST], work[32 * MOST];
} problem;

static iccp_handles *make_handles(const problem *p)
{
    iccp_handles *handles;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_handles_create(&handles, p->dim, p->m, p->handles, &env, NULL), ICC_OK);
    ck_assert_uint_le(iccp_optimise_work(handles), sizeof p->work / sizeof *p->work);
    return handles;
}

static icc_status run(const iccp_handles *handles, int32_t method, problem *p)
{
    memcpy(p->weights, p->start, sizeof p->start);
    return iccp_optimise(handles, method, p->point, p->weights, p->work);
}

/* How far the weights are from summing to 1 and reproducing the point. */
static double error_of(const problem *p)
{
    double sum = -1, worst = 0;
    for (size_t j = 0; j < p->m; ++j)
        sum += p->weights[j];
    for (size_t k = 0; k < p->dim; ++k) {
        double x = -p->point[k];
        for (size_t j = 0; j < p->m; ++j)
            x += p->weights[j] * p->handles[p->dim * j + k];
        worst = fmax(worst, fabs(x));
    }
    return fmax(worst, fabs(sum));
}

static double size_of(const problem *p)
{
    double size = 1;
    for (size_t j = 0; j < p->m; ++j)
        size = fmax(size, fabs(p->start[j]));
    return size;
}

static void random_start(problem *p, random_source *r)
{
    const int kind = random_below(r, 4);
    for (size_t j = 0; j < p->m; ++j) {
        const double u = random_unit(r);
        p->start[j] = kind == 0   ? 0
                      : kind == 1 ? u * u * u * u
                      : kind == 2 ? (double)(random_below(r, 5) == 0)
                                  : (2 * u - 1) * pow(10, random_between(r, -3, 3));
    }
}

static void random_handles(problem *p, random_source *r)
{
    for (size_t k = 0; k < p->dim * p->m; ++k)
        p->handles[k] = random_between(r, -1, 1);
}

/* A mean of handles, most of them with little weight: inside their hull. */
static void point_inside(problem *p, random_source *r)
{
    double total = 0;
    memset(p->point, 0, sizeof p->point);
    for (size_t j = 0; j < p->m; ++j) {
        const double w = -log(1 - random_unit(r)) * pow(10, -random_between(r, 0, 8));
        total += w;
        for (size_t k = 0; k < p->dim; ++k)
            p->point[k] += w * p->handles[p->dim * j + k];
    }
    for (size_t k = 0; k < p->dim; ++k)
        p->point[k] /= total;
}

/* Between two handles, or on one. */
static void point_between(problem *p, size_t a, size_t b, random_source *r)
{
    const double t = random_below(r, 4) == 0 ? random_below(r, 2) : random_unit(r);
    for (size_t k = 0; k < p->dim; ++k)
        p->point[k] = (1 - t) * p->handles[p->dim * a + k] + t * p->handles[p->dim * b + k];
}

/* ---- equality only ---- */

/* Equations 4.4 to 4.6 as they stand, in the plane. */
static void closed_form(const problem *p, double *w)
{
    double s[2][2] = {{0}}, c1[2] = {0}, cw[2] = {0}, sum = 0, right[2], lambda[2];
    const double m = (double)p->m;
    for (size_t j = 0; j < p->m; ++j) {
        const double *c = p->handles + 2 * j;
        sum += p->start[j];
        for (size_t a = 0; a < 2; ++a) {
            c1[a] += c[a];
            cw[a] += c[a] * p->start[j];
            for (size_t b = 0; b < 2; ++b)
                s[a][b] += c[a] * c[b];
        }
    }
    for (size_t a = 0; a < 2; ++a) {
        right[a] = 2 * (cw[a] + (1 - sum) / m * c1[a] - p->point[a]);
        for (size_t b = 0; b < 2; ++b)
            s[a][b] -= c1[a] * c1[b] / m;
    }
    const double det = s[0][0] * s[1][1] - s[0][1] * s[1][0];
    lambda[0] = (s[1][1] * right[0] - s[0][1] * right[1]) / det;
    lambda[1] = (s[0][0] * right[1] - s[1][0] * right[0]) / det;
    const double half_mu = (sum - 1 - 0.5 * (c1[0] * lambda[0] + c1[1] * lambda[1])) / m;
    for (size_t j = 0; j < p->m; ++j)
        w[j] = p->start[j] -
               0.5 * (p->handles[2 * j] * lambda[0] + p->handles[2 * j + 1] * lambda[1]) - half_mu;
}

START_TEST(equality_is_the_closed_form)
{
    random_source r = {11};
    double worst = 0;
    for (int set = 0; set < 200; ++set) {
        static problem p;
        p.dim = 2;
        p.m = 4 + (size_t)random_below(&r, 30);
        /* Corners of a square among them: the printed formula loses digits where handles are nearly
         * on a line. */
        random_handles(&p, &r);
        memcpy(p.handles, (double[]){-1, -1, 1, -1, 1, 1, -1, 1}, 8 * sizeof(double));
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < 50; ++k) {
            double expected[MOST];
            for (size_t j = 0; j < p.m; ++j)
                p.start[j] = random_unit(&r);
            for (size_t c = 0; c < 2; ++c)
                p.point[c] = random_between(&r, -1, 1);
            closed_form(&p, expected);
            ck_assert_int_eq(run(handles, ICC_WEIGHTS_EQUALITY, &p), ICC_OK);
            for (size_t j = 0; j < p.m; ++j)
                worst = fmax(worst, fabs(p.weights[j] - expected[j]));
            worst = fmax(worst, error_of(&p));
        }
        iccp_handles_free(handles);
    }
    ck_assert_double_le(worst, 1e-14);
}
END_TEST

/* ---- quadratic programming ---- */

static double cost_of(const problem *p, const double *w)
{
    double cost = 0;
    for (size_t j = 0; j < p->m; ++j)
        cost += (w[j] - p->start[j]) * (w[j] - p->start[j]);
    return cost;
}

/* The two ways of solving agree, on random points and on faces of the hull. */
START_TEST(both_ways_agree)
{
    random_source r = {12};
    double worst = 0;
    for (int set = 0; set < 400; ++set) {
        static problem p;
        p.dim = 2 + (size_t)random_below(&r, 2);
        p.m = p.dim + 1 + (size_t)random_below(&r, 25);
        random_handles(&p, &r);
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < 30; ++k) {
            double columns[ICCP_ROWS * MOST] = {0}, other[MOST];
            iccp_nonneg same = {.m = p.m, .rows = p.dim + 1, .columns = columns, .total = 1};
            point_inside(&p, &r);
            random_start(&p, &r);
            same.target[0] = 1;
            for (size_t j = 0; j < p.m; ++j) {
                columns[ICCP_ROWS * j] = 1;
                for (size_t c = 0; c < p.dim; ++c)
                    columns[ICCP_ROWS * j + 1 + c] = p.handles[p.dim * j + c];
            }
            for (size_t c = 0; c < p.dim; ++c)
                same.target[1 + c] = p.point[c];
            memcpy(other, p.start, sizeof other);
            ck_assert_int_eq(run(handles, ICC_WEIGHTS_QP, &p), ICC_OK);
            ck_assert(iccp_dual_solve(&same, other, p.work));
            for (size_t j = 0; j < p.m; ++j) {
                ck_assert_double_ge(p.weights[j], 0);
                worst = fmax(worst, fabs(p.weights[j] - other[j]) / size_of(&p));
            }
            ck_assert_double_le(cost_of(&p, p.weights),
                                cost_of(&p, other) + 1e-9 * size_of(&p) * size_of(&p));
        }
        iccp_handles_free(handles);
    }
    ck_assert_double_le(worst, 1e-8);
}
END_TEST

/* Changes that keep the equations, and do not make a weight negative at once, raise the cost; those
 * that keep weights at 0, too, neither raise nor lower it. */
START_TEST(no_feasible_neighbour_is_better)
{
    random_source r = {13};
    for (int set = 0; set < 100; ++set) {
        static problem p;
        p.dim = 2 + (size_t)random_below(&r, 2);
        p.m = p.dim + 2 + (size_t)random_below(&r, 20);
        random_handles(&p, &r);
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < 20; ++k) {
            point_inside(&p, &r);
            random_start(&p, &r);
            ck_assert_int_eq(run(handles, ICC_WEIGHTS_QP, &p), ICC_OK);
            for (int d = 0; d < 20; ++d) {
                double change[MOST], share = HUGE_VAL, uphill = 0;
                for (size_t j = 0; j < p.m; ++j)
                    change[j] = random_between(&r, -1, 1);
                iccp_handles_project(handles, NULL, change);
                for (size_t j = 0; j < p.m; ++j)
                    if (change[j] < 0)
                        share = fmin(share, -p.weights[j] / change[j]);
                for (size_t j = 0; j < p.m; ++j)
                    uphill += (p.weights[j] - p.start[j]) * change[j];
                if (share > 1e-9)
                    ck_assert_double_ge(uphill, -1e-9 * size_of(&p));
                double along = 0, sum = 0;
                iccp_handles_project(handles, p.weights, change);
                for (size_t j = 0; j < p.m; ++j) {
                    along += (p.weights[j] - p.start[j]) * change[j];
                    sum += change[j];
                    if (p.weights[j] <= 0)
                        ck_assert_double_le(fabs(change[j]), 0);
                }
                ck_assert_double_le(fabs(along), 1e-9 * size_of(&p));
                ck_assert_double_le(fabs(sum), 1e-12);
            }
        }
        iccp_handles_free(handles);
    }
}
END_TEST

/* 205,005 problems, of which 5,005 on the edges of the hull; where undamped Newton steps fail. */
START_TEST(nothing_fails)
{
    random_source r = {14};
    size_t n = 0, infeasible = 0;
    double worst = 0;
    for (int set = 0; n < 205005; ++set) {
        static problem p;
        const bool edges = n >= 200000;
        p.dim = 2;
        p.m = edges ? 26 : (size_t[]){4, 10, 26}[set % 3];
        random_handles(&p, &r);
        for (size_t j = 0; edges && j < p.m; ++j) {
            p.handles[2 * j] = cos(6.283185307179586 * (double)j / (double)p.m);
            p.handles[2 * j + 1] = sin(6.283185307179586 * (double)j / (double)p.m);
        }
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < (edges ? 5005 : 1000); ++k, ++n) {
            random_start(&p, &r);
            if (edges)
                point_between(&p, (size_t)k % p.m, (size_t)(k + 1) % p.m, &r);
            else
                point_inside(&p, &r);
            infeasible += run(handles, ICC_WEIGHTS_QP, &p) != ICC_OK;
            worst = fmax(worst, error_of(&p) / size_of(&p));
        }
        iccp_handles_free(handles);
    }
    ck_assert_uint_eq(infeasible, 0);
    ck_assert_double_le(worst, 1e-12);
}
END_TEST

/* Points outside the handles' hull are relaxed, and their weights still sum to 1 and reproduce. */
START_TEST(outside_is_said_and_equations_hold)
{
    random_source r = {15};
    for (int set = 0; set < 200; ++set) {
        static problem p;
        p.dim = 2 + (size_t)random_below(&r, 2);
        p.m = p.dim + 1 + (size_t)random_below(&r, 20);
        random_handles(&p, &r);
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < 50; ++k) {
            double least = 0;
            random_start(&p, &r);
            p.point[0] = 1.001 + random_unit(&r);
            p.point[1] = random_between(&r, -1, 1);
            p.point[2] = random_between(&r, -1, 1);
            ck_assert_int_eq(run(handles, ICC_WEIGHTS_QP, &p), ICC_ERR_SOLVER);
            for (size_t j = 0; j < p.m; ++j)
                least = fmin(least, p.weights[j]);
            ck_assert_double_lt(least, 0);
            ck_assert_double_le(error_of(&p), 1e-10 * size_of(&p));
        }
        iccp_handles_free(handles);
    }
}
END_TEST

/* From one side of the hull to the other, weights hardly change. */
START_TEST(weights_hardly_jump_at_the_hull)
{
    random_source r = {20};
    static problem p, q;
    p.dim = 2;
    p.m = 10;
    for (size_t j = 0; j < 10; ++j) {
        const double radius = j % 2 == 0 ? 1 : 0.4, angle = 0.62831853071795865 * (double)j;
        p.handles[2 * j] = radius * cos(angle);
        p.handles[2 * j + 1] = radius * sin(angle);
    }
    iccp_handles *handles = make_handles(&p);
    for (int k = 0; k < 1000; ++k) {
        random_start(&p, &r);
        for (size_t j = 0; j < p.m; ++j)
            p.start[j] = fmin(1, fabs(p.start[j]));
        point_between(&p, 0, 2, &r);
        q = p;
        for (size_t c = 0; c < 2; ++c) {
            p.point[c] *= 1 - 1e-9;
            q.point[c] *= 1 + 1e-9;
        }
        ck_assert_int_eq(run(handles, ICC_WEIGHTS_QP, &p), ICC_OK);
        ck_assert_int_eq(run(handles, ICC_WEIGHTS_QP, &q), ICC_ERR_SOLVER);
        for (size_t j = 0; j < p.m; ++j)
            ck_assert_double_le(fabs(p.weights[j] - q.weights[j]), 1e-3);
    }
    iccp_handles_free(handles);
}
END_TEST

/* ---- l1 ---- */

static double solve_square(size_t n, double a[4][5], double *x)
{
    double determinant = 1;
    for (size_t c = 0; c < n; ++c) {
        size_t best = c;
        for (size_t k = c + 1; k < n; ++k)
            best = fabs(a[k][c]) > fabs(a[best][c]) ? k : best;
        for (size_t k = 0; k <= n; ++k) {
            const double t = a[c][k];
            a[c][k] = a[best][k];
            a[best][k] = t;
        }
        determinant *= a[c][c];
        if (fabs(a[c][c]) < 1e-9)
            return 0;
        for (size_t q = 0; q < n; ++q)
            for (size_t k = n + 1; q != c && k-- > c;)
                a[q][k] -= a[q][c] / a[c][c] * a[c][k];
    }
    for (size_t c = 0; c < n; ++c)
        x[c] = a[c][n] / a[c][c];
    return determinant;
}

/* The least sum of absolute changes, by trying all sets of dim + 1 handles. */
static double least_by_force(const problem *p)
{
    const size_t rows = p->dim + 1;
    size_t set[4] = {0, 1, 2, 3};
    double least = HUGE_VAL;
    for (;;) {
        double a[4][5], x[4], sum = 0;
        for (size_t r = 0; r < rows; ++r) {
            for (size_t c = 0; c < rows; ++c)
                a[r][c] = r == 0 ? 1 : p->handles[p->dim * set[c] + r - 1];
            a[r][rows] = r == 0 ? 1 : p->point[r - 1];
            for (size_t j = 0; j < p->m; ++j)
                a[r][rows] -= p->start[j] * (r == 0 ? 1 : p->handles[p->dim * j + r - 1]);
        }
        if (fabs(solve_square(rows, a, x)) > 0) {
            for (size_t c = 0; c < rows; ++c)
                sum += fabs(x[c]);
            least = fmin(least, sum);
        }
        size_t k = rows;
        while (k-- > 0 && set[k] == p->m - rows + k)
            continue;
        if (k >= rows)
            return least;
        ++set[k];
        for (size_t c = k + 1; c < rows; ++c)
            set[c] = set[c - 1] + 1;
    }
}

static double sum_of_changes(const problem *p)
{
    double sum = 0;
    for (size_t j = 0; j < p->m; ++j)
        sum += fabs(p->weights[j] - p->start[j]);
    return sum;
}

START_TEST(l1_is_least)
{
    random_source r = {16};
    size_t mixed = 0;
    for (int set = 0; set < 300; ++set) {
        static problem p;
        p.dim = 2 + (size_t)random_below(&r, 2);
        p.m = p.dim + 1 + (size_t)random_below(&r, 8);
        random_handles(&p, &r);
        /* On a lattice many sets of handles are as good as each other. */
        for (size_t k = 0; set % 3 == 0 && k < p.dim * p.m; ++k)
            p.handles[k] =
                k / p.dim < 4 ? (double)(k / p.dim > k % p.dim) : random_below(&r, 3) - 1;
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < 40; ++k) {
            bool up = false, down = false;
            random_start(&p, &r);
            for (size_t j = 0; set % 2 == 0 && j < p.m; ++j)
                p.start[j] = random_between(&r, -1, 1);
            if (k % 2 == 0)
                point_inside(&p, &r);
            else
                point_between(&p, (size_t)random_below(&r, (int)p.m),
                              (size_t)random_below(&r, (int)p.m), &r);
            ck_assert_int_eq(run(handles, ICC_WEIGHTS_L1, &p), ICC_OK);
            const double least = least_by_force(&p);
            ck_assert_double_le(error_of(&p), 1e-10 * size_of(&p));
            ck_assert_double_le(fabs(sum_of_changes(&p) - least), 1e-7 * (least + 1e-3));
            for (size_t j = 0; j < p.m; ++j) {
                up |= p.weights[j] - p.start[j] > 1e-6;
                down |= p.weights[j] - p.start[j] < -1e-6;
            }
            mixed += up && down;
        }
        iccp_handles_free(handles);
    }
    /* Both regimes have been seen. */
    ck_assert_uint_gt(mixed, 1000);
    ck_assert_uint_lt(mixed, 11000);
}
END_TEST

/* Of all solutions the one with the least sum of squares: no change that keeps the equations and
 * does not raise the sum of absolute changes lowers that of squares. */
START_TEST(l1_breaks_ties_by_squares)
{
    random_source r = {17};
    size_t tied = 0;
    for (int set = 0; set < 200; ++set) {
        static problem p;
        p.dim = 2;
        p.m = 6 + (size_t)random_below(&r, 20);
        random_handles(&p, &r);
        iccp_handles *handles = make_handles(&p);
        for (int k = 0; k < 20; ++k) {
            point_inside(&p, &r);
            random_start(&p, &r);
            ck_assert_int_eq(run(handles, ICC_WEIGHTS_L1, &p), ICC_OK);
            for (int d = 0; d < 20; ++d) {
                double change[MOST], uphill = 0, slope = 0;
                for (size_t j = 0; j < p.m; ++j)
                    change[j] = random_between(&r, -1, 1);
                iccp_handles_project(handles, NULL, change);
                for (size_t j = 0; j < p.m; ++j) {
                    const double v = p.weights[j] - p.start[j];
                    uphill += v * change[j];
                    slope += fabs(v) > 1e-9 ? copysign(change[j], v * change[j]) : fabs(change[j]);
                }
                if (slope > 1e-9)
                    continue;
                ++tied;
                ck_assert_double_ge(uphill, -1e-8 * size_of(&p));
            }
        }
        iccp_handles_free(handles);
    }
    ck_assert_uint_gt(tied, 100);
}
END_TEST

/* ---- table 4.1 ---- */

/* The thesis' example: a grid of 101 x 101 samples over 10 x 10, handles at its corners, inverse
 * distances. QP has no negative weights, equality only has them down to -0.106, l1 hardly any;
 * along the diagonal weights fall with QP and l1 but for what a corner's own initial weight does
 * beside it, and rise again with equality only. */
START_TEST(the_example_of_chapter_4)
{
    enum { SIDE = 101, N = 4 + SIDE * SIDE };
    static double points[2 * N], initial[4 * N];
    static problem p = {.dim = 2, .m = 4, .handles = {0, 0, 10, 0, 10, 10, 0, 10}};
    const iccp_nodes nodes = {.dim = 2, .n = N, .n_handles = 4, .points = points};
    memcpy(points, p.handles, 8 * sizeof *points);
    for (size_t i = 4; i < N; ++i) {
        points[2 * i] = 0.1 * (double)((i - 4) % SIDE);
        points[2 * i + 1] = 0.1 * (double)((i - 4) / SIDE);
    }
    iccp_initial_inverse(&nodes, initial);
    ck_assert_double_eq(initial[0], 1);
    ck_assert_double_eq(initial[1], 0);
    ck_assert_double_le(fabs(initial[4 * (4 + 10)] - 0.5), 1e-12);
    iccp_handles *handles = make_handles(&p);
    for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
        double least = 0, rise = 0, before = 2;
        for (size_t i = 4; i < N; ++i) {
            memcpy(p.point, points + 2 * i, 2 * sizeof *points);
            memcpy(p.start, initial + 4 * i, 4 * sizeof *initial);
            ck_assert_int_eq(run(handles, method, &p), ICC_OK);
            for (size_t j = 0; j < 4; ++j)
                least = fmin(least, p.weights[j]);
            if ((i - 4) % (SIDE + 1) == 0) {
                rise = fmax(rise, p.weights[0] - before);
                before = p.weights[0];
            }
        }
        if (method == ICC_WEIGHTS_EQUALITY) {
            ck_assert_double_le(fabs(least + 0.106), 5e-4);
            ck_assert_double_gt(rise, 0.01);
        } else {
            ck_assert_double_ge(least, method == ICC_WEIGHTS_QP ? 0 : -0.01);
            ck_assert_double_le(rise, 2e-3);
        }
    }
    iccp_handles_free(handles);
}
END_TEST

/* ---- lines ---- */

/* Weights are linear on a line, and change by the same vector per length on one that is parallel to
 * it, whichever way that runs: the images under any translations of the handles are parallel. */
START_TEST(lines_are_straight_and_parallel)
{
    enum { N = 10 };
    const double points[2 * N] = {0,   0,   1,   1,    0.3, 0.3, 0.5, 0.5, 0.9, 0.9,
                                  0.7, 0.2, 0.2, -0.3, 0.5, 0,   0,   0,   0,   0};
    const iccp_nodes nodes = {.dim = 2, .n = N, .n_handles = 5, .points = points};
    const iccp_line_nodes first = {.from = 0, .to = 1, .first = 2, .count = 3};
    const iccp_line_nodes second = {.from = 5, .to = 6, .first = 7, .count = 1};
    double w[5 * N];
    random_source r = {19};
    for (size_t k = 0; k < 5 * N; ++k)
        w[k] = random_unit(&r);
    iccp_straighten(&nodes, &first, NULL, w);
    iccp_straighten(&nodes, &second, &first, w);
    for (size_t j = 0; j < 5; ++j) {
        for (size_t i = 2; i < 5; ++i) {
            const double t = points[2 * i];
            ck_assert_double_le(fabs(w[5 * i + j] - (1 - t) * w[j] - t * w[5 + j]), 1e-15);
        }
        ck_assert_double_le(fabs(w[35 + j] - w[25 + j] - 0.4 * (w[30 + j] - w[25 + j])), 1e-15);
        ck_assert_double_le(fabs(w[30 + j] - w[25 + j] + 0.5 * (w[5 + j] - w[j])), 1e-15);
    }
}
END_TEST

/* ---- handles ---- */

START_TEST(handles_on_a_line_are_refused)
{
    iccp_handles *handles;
    iccp_env env;
    icc_error err = {.size = sizeof err};
    const double line[8] = {0, 0, 1, 1, 2, 2, 3, 3};
    const double plane[12] = {0, 0, 1, 1, 0, 2, 0, 1, 3, 1, 1, 4};
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_handles_create(&handles, 2, 4, line, &env, &err), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(handles);
    ck_assert_ptr_nonnull(strstr(err.message, "line"));
    ck_assert_int_eq(iccp_handles_create(&handles, 3, 4, plane, &env, &err), ICC_ERR_ARGUMENT);
    ck_assert_ptr_null(handles);
}
END_TEST

/* Handles stretched to a thin strip, exactly: the weights are the same. */
START_TEST(place_and_size_do_not_matter)
{
    random_source r = {18};
    for (int set = 0; set < 50; ++set) {
        static problem p, q;
        p.dim = 2;
        p.m = 8;
        random_handles(&p, &r);
        q = p;
        for (size_t k = 0; k < 16; ++k)
            q.handles[k] = ldexp(p.handles[k], 10 - 20 * (int)(k % 2));
        iccp_handles *before = make_handles(&p), *after = make_handles(&q);
        for (int k = 0; k < 20; ++k) {
            point_inside(&p, &r);
            random_start(&p, &r);
            memcpy(q.start, p.start, sizeof p.start);
            q.point[0] = ldexp(p.point[0], 10);
            q.point[1] = ldexp(p.point[1], -10);
            for (int32_t method = ICC_WEIGHTS_QP; method <= ICC_WEIGHTS_L1; ++method) {
                ck_assert_int_eq(run(before, method, &p), ICC_OK);
                ck_assert_int_eq(run(after, method, &q), ICC_OK);
                for (size_t j = 0; j < p.m; ++j)
                    ck_assert_double_le(fabs(p.weights[j] - q.weights[j]), 1e-6 * size_of(&p));
            }
        }
        iccp_handles_free(before);
        iccp_handles_free(after);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("weights");
    TCase *points = tcase_create("points");
    tcase_add_test(points, equality_is_the_closed_form);
    tcase_add_test(points, both_ways_agree);
    tcase_add_test(points, no_feasible_neighbour_is_better);
    tcase_add_test(points, nothing_fails);
    tcase_add_test(points, outside_is_said_and_equations_hold);
    tcase_add_test(points, weights_hardly_jump_at_the_hull);
    tcase_add_test(points, l1_is_least);
    tcase_add_test(points, l1_breaks_ties_by_squares);
    tcase_add_test(points, the_example_of_chapter_4);
    tcase_add_test(points, lines_are_straight_and_parallel);
    tcase_add_test(points, handles_on_a_line_are_refused);
    tcase_add_test(points, place_and_size_do_not_matter);
    suite_add_tcase(suite, points);
    return suite_run(suite);
}
