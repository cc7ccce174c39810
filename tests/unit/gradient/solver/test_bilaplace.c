/* Bi-Laplace functions against dense references. */
#include "base/error.h"
#include "gradient/function/critical_points.h"
#include "gradient/solver/bilaplace.h"
#include "gradient/solver/energy.h"
#include "gradient/solver/interior_point.h"
#include "gradient/solver/nested.h"
#include "gradient/solver/polish.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../hard_masks.h"
#include "../../../random.h"
#include "../../../share.h"
#include "../../../suite.h"

#include <check.h>
#include <math.h>
#include <string.h>

typedef struct problem {
    icc_tree *tree;
    iccp_unknowns unknowns;
    size_t n;
    iccp_scaled f;
} problem;

static problem problem_on(int32_t dim, const size_t *sides, const uint8_t *inside, uint32_t root)
{
    const iccp_env env = default_env();
    problem p;
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create_mask(&grid, dim, sides, inside, NULL, NULL), ICC_OK);
    if (root == UINT32_MAX)
        ck_assert_int_eq(icc_grid_find_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&p.tree, grid, root, NULL, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    ck_assert_int_eq(iccp_unknowns_create(&p.unknowns, p.tree, &env), ICC_OK);
    p.n = p.unknowns.n;
    p.f.fraction = malloc(p.n * sizeof *p.f.fraction);
    p.f.exponent = malloc(p.n * sizeof *p.f.exponent);
    return p;
}

static problem problem_of(mask_shape shape, int32_t dim, size_t cells)
{
    mask m = mask_draw(shape, dim, cells);
    const problem p = problem_on(dim, m.shape, m.inside, UINT32_MAX);
    mask_free(&m);
    return p;
}

/* Few vertices, ragged, up to the border of the grid. */
static problem random_problem(random_source *r, int32_t dim)
{
    uint8_t inside[256];
    size_t sides[ICC_MAX_DIM], n = 1;
    const int most[] = {0, 20, 8, 5, 3};
    for (int32_t k = 0; k < dim; ++k)
        n *= sides[k] = (size_t)(2 + random_below(r, most[dim] - 1));
    const int density = 5 + random_below(r, 6);
    for (size_t v = 0; v < n; ++v)
        inside[v] = random_below(r, 10) < density;
    const uint32_t root = (uint32_t)random_below(r, (int)n);
    inside[root] = 1;
    return problem_on(dim, sides, inside, root);
}

static void problem_clear(problem *p)
{
    iccp_unknowns_free(&p->unknowns);
    icc_tree_free(p->tree);
    free(p->f.fraction);
    free(p->f.exponent);
}

static double value(const problem *p, size_t k)
{
    return iccp_scaled_get(&p->f, k, 0);
}

/* ------------------------------------------------------------ dense reference */

/* The Laplacians on the grid with a margin of one more vertex: a row of `m` for each vertex that is
 * inside or, clamped, next to one. */
typedef struct dense {
    size_t n, m;
    long double *a; /* m * n */
} dense;

static void unpack(const icc_grid *grid, uint32_t v, int position[ICC_MAX_DIM])
{
    for (int32_t k = 0; k < grid->dim; ++k)
        position[k] = (int)iccp_grid_coordinate(grid, v, k);
}

static int distance(const icc_grid *grid, const int *p, const int *q)
{
    int sum = 0;
    for (int32_t k = 0; k < grid->dim; ++k)
        sum += abs(p[k] - q[k]);
    return sum;
}

/* All vertices at distance 1 of row k, inside or not, are judged by distances to all rows. */
static dense dense_laplacians(const problem *p, bool clamped)
{
    const icc_grid *grid = p->tree->grid;
    const size_t n = p->n, most = n * (1 + 2 * (size_t)grid->dim);
    int(*place)[ICC_MAX_DIM] = malloc(most * sizeof *place);
    dense d = {n, n, calloc(most * n, sizeof *d.a)};
    for (size_t k = 0; k < n; ++k)
        unpack(grid, p->unknowns.vertex[k], place[k]);
    for (size_t k = 0; k < n && clamped; ++k)
        for (int32_t i = 0; i < 2 * grid->dim; ++i) {
            memcpy(place[d.m], place[k], sizeof *place);
            place[d.m][i / 2] += i % 2 ? 1 : -1;
            bool is_new = true;
            for (size_t j = 0; j < d.m && is_new; ++j)
                is_new = distance(grid, place[j], place[d.m]) > 0;
            d.m += is_new;
        }
    for (size_t i = 0; i < d.m; ++i)
        for (size_t j = 0; j < n; ++j) {
            const int away = distance(grid, place[i], place[j]);
            d.a[i * n + j] = away == 0 ? 2 * grid->dim : away == 1 ? -1 : 0;
        }
    free(place);
    return d;
}

/* Solves h x = b, h symmetric positive definite, n by n; both are overwritten. */
static void dense_solve(size_t n, long double *h, long double *b)
{
    for (size_t k = 0; k < n; ++k) {
        ck_assert(h[k * n + k] > 0);
        for (size_t i = k + 1; i < n; ++i) {
            const long double factor = h[i * n + k] / h[k * n + k];
            for (size_t j = k; j < n && factor != 0; ++j)
                h[i * n + j] -= factor * h[k * n + j];
            b[i] -= factor * b[k];
        }
    }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = k + 1; j < n; ++j)
            b[k] -= h[k * n + j] * b[j];
        b[k] /= h[k * n + k];
    }
}

/* A'A, n by n. */
static long double *dense_energy(const dense *d)
{
    long double *h = calloc(d->n * d->n, sizeof *h);
    for (size_t r = 0; r < d->m; ++r)
        for (size_t i = 0; i < d->n; ++i)
            for (size_t j = 0; j < d->n && d->a[r * d->n + i] != 0; ++j)
                h[i * d->n + j] += d->a[r * d->n + i] * d->a[r * d->n + j];
    return h;
}

/* The minimum with f = 1 at the root, row 0. */
static long double *dense_minimum(const problem *p, bool clamped)
{
    dense d = dense_laplacians(p, clamped);
    const size_t n = p->n;
    long double *h = dense_energy(&d), *f = malloc(n * sizeof *f);
    for (size_t i = 0; i < n; ++i) {
        f[i] = i == 0 ? 1 : -h[i * n];
        h[i * n] = h[i] = i == 0;
    }
    dense_solve(n, h, f);
    free(h);
    free(d.a);
    return f;
}

/* ------------------------------------------------------------------- tests */

static const int32_t FUNCTIONS[2] = {ICC_FUNCTION_BILAPLACE, ICC_FUNCTION_CLAMPED};

START_TEST(small_minima_are_those_of_a_dense_solver)
{
    random_source r = {1};
    const iccp_env env = default_env();
    for (int round = 0; round < share_of(200); ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        for (int k = 0; k < 2; ++k) {
            iccp_solution info = {0};
            ck_assert_int_eq(
                iccp_bilaplace(&p.unknowns, FUNCTIONS[k], ICC_SOLVER_DIRECT, &p.f, &info, &env),
                ICC_OK);
            long double *f = dense_minimum(&p, FUNCTIONS[k] == ICC_FUNCTION_CLAMPED);
            ck_assert_double_eq(value(&p, 0), 1);
            ck_assert_double_le(info.residual, 1e-12);
            for (size_t i = 0; i < p.n; ++i) {
                const double scale = k == 0 ? (double)f[i] : 1;
                ck_assert_double_le(fabs(value(&p, i) - (double)f[i]), 1e-12 * scale);
                ck_assert(k == 1 || value(&p, i) > 0);
            }
            free(f);
        }
        problem_clear(&p);
    }
}
END_TEST

/* The iterative solver agrees with the direct one, or knows that it cannot. */
START_TEST(both_solvers_agree)
{
    const iccp_env env = default_env();
    int n_solved = 0;
    for (int s = 0; s < N_MASKS; ++s) {
        const int32_t dim = mask_number(s).dim == 3 ? 3 : 2;
        problem p = problem_of(mask_number(s).shape, dim, dim == 3 ? 20 : 60);
        iccp_solution info = {0};
        ck_assert_int_eq(iccp_bilaplace(&p.unknowns, ICC_FUNCTION_BILAPLACE, ICC_SOLVER_DIRECT,
                                        &p.f, &info, &env),
                         ICC_OK);
        double *direct = malloc(p.n * sizeof *direct);
        for (size_t k = 0; k < p.n; ++k)
            direct[k] = value(&p, k);
        const icc_status status = iccp_bilaplace(&p.unknowns, ICC_FUNCTION_BILAPLACE,
                                                 ICC_SOLVER_ITERATIVE, &p.f, &info, &env);
        ck_assert(status == ICC_OK || status == ICC_ERR_SOLVER);
        ck_assert_uint_gt(info.n_inner, 0);
        for (size_t k = 0; k < p.n && status == ICC_OK; ++k)
            ck_assert_double_le(fabs(value(&p, k) - direct[k]), 1e-6 * direct[k]);
        n_solved += status == ICC_OK;
        free(direct);
        problem_clear(&p);
    }
    ck_assert_int_ge(n_solved, 6);
}
END_TEST

START_TEST(nothing_underflows)
{
    const iccp_env env = default_env();
    problem p = problem_of(mask_serpentine, 2, 500);
    iccp_solution info = {0};
    ck_assert_int_eq(
        iccp_bilaplace(&p.unknowns, ICC_FUNCTION_BILAPLACE, ICC_SOLVER_DIRECT, &p.f, &info, &env),
        ICC_OK);
    int32_t least = 0;
    for (size_t k = 0; k < p.n; ++k) {
        ck_assert(p.f.fraction[k] >= 0.5 && p.f.fraction[k] < 1);
        least = p.f.exponent[k] < least ? p.f.exponent[k] : least;
    }
    ck_assert_int_lt(least, -1100); /* below 1e-331 */
    problem_clear(&p);
}
END_TEST

/* ------------------------------------------------- the tree's inequalities */

/* The program in the values but for the root's, dense: 1/2 x'Hx + c'x + e is to be least under G x
 * >= b. */
typedef struct dense_program {
    size_t n, m;
    long double *h, *inverse, *c, *g, *b, e;
} dense_program;

static long double *dense_inverse(size_t n, const long double *h)
{
    long double *inverse = calloc(n * n + 1, sizeof *inverse);
    long double *copy = malloc((n * n + 1) * sizeof *copy);
    for (size_t i = 0; i < n; ++i) {
        memcpy(copy, h, n * n * sizeof *copy);
        inverse[i * n + i] = 1;
        dense_solve(n, copy, inverse + i * n);
    }
    free(copy);
    return inverse;
}

static void add_inequalities(dense_program *d, const problem *p, double eta, double leaf)
{
    const size_t n = d->n;
    d->m = n;
    for (size_t k = 1; k <= n; ++k) {
        bool is_leaf = true;
        const uint32_t parent = p->unknowns.parent[k];
        if (parent > 0)
            d->g[(k - 1) * n + parent - 1] = 1;
        d->g[(k - 1) * n + k - 1] = -(1 + eta);
        d->b[k - 1] = parent > 0 ? 0 : -1;
        for (size_t j = 1; j <= n; ++j)
            is_leaf = is_leaf && p->unknowns.parent[j] != k;
        if (is_leaf) {
            d->g[d->m * n + k - 1] = 1;
            d->b[d->m++] = leaf;
        }
    }
}

static dense_program dense_program_of(const problem *p, bool clamped, double eta, double leaf)
{
    dense a = dense_laplacians(p, clamped);
    long double *full = dense_energy(&a);
    dense_program d = {.n = p->n - 1};
    const size_t n = d.n;
    d.h = malloc(p->n * p->n * sizeof *d.h);
    d.c = malloc(p->n * sizeof *d.c);
    d.g = calloc(2 * p->n * p->n, sizeof *d.g);
    d.b = calloc(2 * p->n, sizeof *d.b);
    d.e = full[0] / 2;
    for (size_t i = 0; i < n; ++i) {
        d.c[i] = full[i + 1];
        for (size_t j = 0; j < n; ++j)
            d.h[i * n + j] = full[(i + 1) * p->n + j + 1];
    }
    d.inverse = dense_inverse(n, d.h);
    add_inequalities(&d, p, eta, leaf);
    free(full);
    free(a.a);
    return d;
}

static void dense_program_clear(dense_program *d)
{
    free(d->h);
    free(d->inverse);
    free(d->c);
    free(d->g);
    free(d->b);
}

static long double product(size_t n, const long double *x, const long double *y)
{
    long double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += x[i] * y[i];
    return sum;
}

static long double dense_energy_at(const dense_program *d, const long double *x)
{
    long double sum = d->e + product(d->n, d->c, x);
    for (size_t i = 0; i < d->n; ++i)
        sum += x[i] * product(d->n, d->h + i * d->n, x) / 2;
    return sum;
}

/* A lower bound of the energy of every function that fulfils the inequalities: the dual function at
 * multipliers found by C. Hildreth, A quadratic programming procedure, 1957: one at a time, over
 * and over. */
static long double lower_bound(const dense_program *d)
{
    const size_t n = d->n, m = d->m;
    long double *x = calloc(n, sizeof *x), *y = calloc(m, sizeof *y), bound = d->e;
    long double *v = malloc(m * n * sizeof *v); /* H^-1 G' */
    for (size_t i = 0; i < m; ++i)
        for (size_t j = 0; j < n; ++j)
            v[i * n + j] = product(n, d->inverse + j * n, d->g + i * n);
    for (size_t j = 0; j < n; ++j)
        x[j] = -product(n, d->inverse + j * n, d->c);
    for (int sweep = 0; sweep < 4000; ++sweep)
        for (size_t i = 0; i < m; ++i) {
            const long double *g = d->g + i * n;
            const long double slack = product(n, g, x) - d->b[i];
            const long double next = fmaxl(0, y[i] - slack / product(n, g, v + i * n));
            for (size_t j = 0; j < n && next != y[i]; ++j)
                x[j] += (next - y[i]) * v[i * n + j];
            y[i] = next;
        }
    /* x minimises the Lagrange function of y, whose value is the energy less what the slacks
     * add. */
    bound = dense_energy_at(d, x);
    for (size_t i = 0; i < m; ++i)
        bound -= y[i] * (product(n, d->g + i * n, x) - d->b[i]);
    free(x);
    free(y);
    free(v);
    return bound;
}

static void check_feasible(const problem *p, const double *f, double eta, double leaf)
{
    bool *has_child = calloc(p->n, sizeof *has_child);
    ck_assert_double_eq(f[0], 1);
    for (size_t k = 1; k < p->n; ++k) {
        has_child[p->unknowns.parent[k]] = true;
        ck_assert((1 + eta) * f[k] <= f[p->unknowns.parent[k]]);
    }
    for (size_t k = 1; k < p->n; ++k)
        ck_assert(has_child[k] || f[k] >= leaf * (1 - 1e-12));
    free(has_child);
}

static double *values(const problem *p)
{
    double *f = malloc(p->n * sizeof *f);
    for (size_t k = 0; k < p->n; ++k)
        f[k] = value(p, k);
    return f;
}

/* Feasible, and of an energy that no feasible function can have less of, up to what the bound
 * lacks: it is slow in telling apart the leaves of a cluster, whose slacks differ by eta * leaf. */
static void check_optimal(const problem *p, const double *f, bool clamped, double eta, double leaf)
{
    dense_program d = dense_program_of(p, clamped, eta, leaf);
    long double *x = malloc(p->n * sizeof *x);
    check_feasible(p, f, eta, leaf);
    for (size_t k = 1; k < p->n; ++k)
        x[k - 1] = f[k];
    const long double energy = dense_energy_at(&d, x), bound = lower_bound(&d);
    ck_assert_double_le((double)(energy - bound), (1e-8 + eta * leaf) * (double)energy);
    ck_assert_double_ge((double)(energy - bound), -1e-9 * (double)energy);
    free(x);
    dense_program_clear(&d);
}

START_TEST(small_constrained_minima_have_the_least_energy)
{
    static const double ETAS[] = {1e-6, 1e-3, 0.01}, LEAVES[] = {1e-9, 1e-4, 0.01};
    random_source r = {2};
    const iccp_env env = default_env();
    for (int round = 0; round < share_of(120); ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        const double eta = ETAS[random_below(&r, 3)], leaf = LEAVES[random_below(&r, 3)];
        for (int k = 0; k < 2 && p.n > 1 && p.n < 40; ++k) {
            iccp_solution info = {0};
            ck_assert_int_eq(
                iccp_bilaplace_constrained(&p.unknowns, FUNCTIONS[k], eta, leaf, &p.f, &info, &env),
                ICC_OK);
            ck_assert_double_le(info.residual_before, 1e-11);
            ck_assert_double_le(info.residual, 1e-9);
            ck_assert_uint_gt(info.n_iterations, 0);
            double *f = values(&p);
            check_optimal(&p, f, k == 1, eta, leaf);
            free(f);
        }
        problem_clear(&p);
    }
}
END_TEST

/* The function and its residual by the interior point method, whether or not it is needed. */
static icc_status solve_from_inside(const problem *p, int32_t function, double *f, double *residual,
                                    const iccp_env *env)
{
    iccp_solution info = {0};
    iccp_qp qp;
    iccp_interior_point ip;
    bool stuck = false;
    icc_status status = iccp_qp_create(&qp, &p->unknowns, function, 1e-6, 1e-9, env);
    if (status != ICC_OK)
        return status;
    uint8_t *active = malloc(iccp_qp_inequalities(&qp));
    iccp_candidate candidate = {f, HUGE_VAL};
    status = iccp_interior_point_create(&ip, &qp, &info, env);
    if (status == ICC_OK) {
        status = iccp_interior_point_run(&ip, 1e-17, &stuck, &info, env);
        for (size_t i = 0; i < iccp_qp_inequalities(&qp); ++i) {
            ck_assert(ip.newton.slack[i] > 0 && ip.newton.multiplier[i] > 0);
            active[i] = ip.newton.multiplier[i] > ip.newton.slack[i];
        }
        if (status == ICC_OK)
            status = iccp_polish(&qp, active, false, 1e-12, &candidate, &info, env);
        iccp_interior_point_free(&ip);
    }
    *residual = candidate.residual;
    free(active);
    iccp_qp_free(&qp);
    return status;
}

START_TEST(both_ways_lead_to_the_same_function)
{
    const iccp_env env = default_env();
    const int shapes[] = {0, 2, 3, 4, 8, 9, 10};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; ++s)
        for (int k = 0; k < 2; ++k) {
            const int32_t dim = mask_number(shapes[s]).dim == 3 ? 3 : 2;
            problem p = problem_of(mask_number(shapes[s]).shape, dim, dim == 3 ? 20 : 50);
            iccp_solution info = {0};
            double residual, *f = malloc(p.n * sizeof *f);
            ck_assert_int_eq(iccp_bilaplace_constrained(&p.unknowns, FUNCTIONS[k], 1e-6, 1e-9, &p.f,
                                                        &info, &env),
                             ICC_OK);
            ck_assert_int_eq(solve_from_inside(&p, FUNCTIONS[k], f, &residual, &env), ICC_OK);
            ck_assert_double_le(info.residual_before, 1e-11);
            ck_assert_double_le(residual, 1e-8);
            for (size_t i = 0; i < p.n; ++i)
                ck_assert_double_le(fabs(f[i] - value(&p, i)), 1e-6);
            free(f);
            problem_clear(&p);
        }
}
END_TEST

/* The active set goes astray here, and the interior point method tells it where to begin. */
START_TEST(a_serpentine_needs_both_ways)
{
    const iccp_env env = default_env();
    problem p = problem_of(mask_serpentine, 2, 225);
    iccp_solution info = {0};
    ck_assert_int_eq(iccp_bilaplace_constrained(&p.unknowns, ICC_FUNCTION_BILAPLACE, 1e-6, 1e-9,
                                                &p.f, &info, &env),
                     ICC_OK);
    ck_assert_double_le(info.residual_before, 1e-11);
    problem_clear(&p);
}
END_TEST

/* The same from coarse to fine, without what follows for large problems. */
static icc_status solve_nested(const problem *p, int32_t function, size_t coarsest, double *f,
                               double *residual, iccp_solution *info, const iccp_env *env)
{
    iccp_qp qp;
    icc_status status = iccp_qp_create(&qp, &p->unknowns, function, 1e-6, 1e-9, env);
    if (status != ICC_OK)
        return status;
    uint8_t *active = calloc(iccp_qp_inequalities(&qp), 1);
    iccp_candidate candidate = {f, HUGE_VAL};
    iccp_nested nested;
    bool useful;
    status = iccp_nested_create(&nested, &useful, &qp, function, coarsest, info, env);
    if (status == ICC_OK && useful) {
        status = iccp_smoothing_run(&nested.smoothing, 1e-12, &candidate, active, info, env);
        iccp_nested_free(&nested);
    }
    *residual = candidate.residual;
    free(active);
    iccp_qp_free(&qp);
    return status;
}

START_TEST(coarse_to_fine_leads_there_too)
{
    const iccp_env env = default_env();
    const int shapes[] = {0, 2, 3, 4};
    for (size_t s = 0; s < sizeof shapes / sizeof *shapes; ++s)
        for (int k = 0; k < 2; ++k) {
            problem p = problem_of(mask_number(shapes[s]).shape, 2, 64);
            iccp_solution info = {0}, nested = {0};
            double residual, *f = malloc(p.n * sizeof *f);
            ck_assert_int_eq(iccp_bilaplace_constrained(&p.unknowns, FUNCTIONS[k], 1e-6, 1e-9, &p.f,
                                                        &info, &env),
                             ICC_OK);
            ck_assert_int_eq(solve_nested(&p, FUNCTIONS[k], 300, f, &residual, &nested, &env),
                             ICC_OK);
            ck_assert_double_le(residual, 1e-11);
            for (size_t i = 0; i < p.n; ++i)
                ck_assert_double_le(fabs(f[i] - value(&p, i)), 1e-8);
            free(f);
            problem_clear(&p);
        }
}
END_TEST

/* A comb whose teeth no coarser grid has: there is no candidate, and that is all. */
START_TEST(grids_that_lose_the_shape_are_not_used)
{
    enum { N = 41 };
    const iccp_env env = default_env();
    static uint8_t inside[N * N];
    for (size_t v = 0; v < sizeof inside; ++v)
        inside[v] = v / N == 20 || v % N % 2 == 1;
    const size_t sides[2] = {N, N};
    problem p = problem_on(2, sides, inside, 20 * N);
    iccp_solution info = {0};
    double residual, *f = malloc(p.n * sizeof *f);
    ck_assert_int_eq(solve_nested(&p, FUNCTIONS[0], 10, f, &residual, &info, &env), ICC_OK);
    ck_assert(residual == HUGE_VAL);
    free(f);
    problem_clear(&p);
}
END_TEST

/* As large as needs coarser grids within iccp_bilaplace_constrained(). */
START_TEST(large_problems_hold_every_inequality)
{
    const iccp_env env = default_env();
    problem p = problem_of(mask_c, 2, 330);
    iccp_solution info = {0};
    ck_assert_uint_ge(p.n, 50000);
    ck_assert_int_eq(
        iccp_bilaplace_constrained(&p.unknowns, FUNCTIONS[_i], 1e-6, 1e-9, &p.f, &info, &env),
        ICC_OK);
    ck_assert_double_le(info.residual_before, 1e-11);
    ck_assert_double_le(info.residual, 1e-9);
    ck_assert_uint_gt(info.n_active, p.n / 2);
    double *f = values(&p);
    check_feasible(&p, f, 1e-6, 1e-9);
    free(f);
    problem_clear(&p);
}
END_TEST

START_TEST(a_letter_c_has_one_critical_point)
{
    const iccp_env env = default_env();
    problem p = problem_of(mask_c, 2, 200);
    iccp_solution info = {0};
    ck_assert_int_eq(
        iccp_bilaplace_constrained(&p.unknowns, FUNCTIONS[_i], 1e-6, 1e-9, &p.f, &info, &env),
        ICC_OK);
    ck_assert_double_le(info.residual_before, 1e-11);
    ck_assert_double_le(info.residual, 1e-9);
    ck_assert_uint_gt(info.n_active, p.n / 2);
    double *f = values(&p);
    check_feasible(&p, f, 1e-6, 1e-9);
    free(f);
    icc_function *field;
    icc_function_report report = {.size = sizeof report};
    ck_assert_int_eq(iccp_function_new(&field, p.tree, &env), ICC_OK);
    ck_assert_int_eq(iccp_function_assign(field, &p.unknowns, &p.f), ICC_OK);
    ck_assert_int_eq(iccp_function_verify(field, &report, &env), ICC_OK);
    ck_assert_uint_eq(report.n_maxima, 1);
    ck_assert_uint_eq(report.n_minima + report.n_saddles, 0);
    iccp_function_release(field);
    problem_clear(&p);
}
END_TEST

static void keep_line(void *user, const char *line)
{
    strncpy(user, line, 99);
}

START_TEST(bounds_without_room_are_refused)
{
    enum { N = 2200 }; /* 1.01^2199 * 1e-9 > 1 */
    uint8_t inside[N];
    char line[100] = "";
    memset(inside, 1, sizeof inside);
    const size_t sides[1] = {N};
    const icc_env outer = {.size = sizeof outer, .user = line, .log = keep_line};
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
    problem p = problem_on(1, sides, inside, 0);
    iccp_solution info = {0};
    ck_assert_int_eq(
        iccp_bilaplace_constrained(&p.unknowns, FUNCTIONS[0], 0.01, 1e-9, &p.f, &info, &env),
        ICC_ERR_SOLVER);
    ck_assert(strstr(line, "at the root") != NULL);
    problem_clear(&p);
}
END_TEST

typedef struct sweep_case {
    problem p;
    int32_t function;
    int way; /* without inequalities, with them, by the interior point method, iteratively, from coarse
                to fine */
} sweep_case;

static icc_status solve_anew(const icc_env *outer, icc_error *err, void *argument)
{
    sweep_case *c = argument;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, outer, err), ICC_OK);
    iccp_solution info = {0};
    if (c->way == 4)
        return iccp_explain(err, solve_nested(&c->p, c->function, 30, c->p.f.fraction,
                                              &info.residual, &info, &env));
    return iccp_explain(
        err, c->way == 0   ? iccp_bilaplace(&c->p.unknowns, c->function, ICC_SOLVER_DIRECT, &c->p.f,
                                            &info, &env)
             : c->way == 3 ? iccp_bilaplace(&c->p.unknowns, c->function, ICC_SOLVER_ITERATIVE,
                                            &c->p.f, &info, &env)
             : c->way == 1
                 ? iccp_bilaplace_constrained(&c->p.unknowns, c->function, 1e-6, 1e-9, &c->p.f,
                                              &info, &env)
                 : solve_from_inside(&c->p, c->function, c->p.f.fraction, &info.residual, &env));
}

START_TEST(failures_leave_nothing_behind)
{
    for (int k = 0; k < 10; ++k) {
        sweep_case c = {problem_of(mask_c, 2, 16), FUNCTIONS[k % 2], k / 2};
        faulty_sweep(solve_anew, &c);
        problem_clear(&c.p);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("bi-Laplace");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 300);
    tcase_add_test(tests, small_minima_are_those_of_a_dense_solver);
    tcase_add_test(tests, both_solvers_agree);
    tcase_add_test(tests, nothing_underflows);
    tcase_add_test(tests, small_constrained_minima_have_the_least_energy);
    tcase_add_test(tests, both_ways_lead_to_the_same_function);
    tcase_add_test(tests, a_serpentine_needs_both_ways);
    tcase_add_test(tests, coarse_to_fine_leads_there_too);
    tcase_add_test(tests, grids_that_lose_the_shape_are_not_used);
    tcase_add_loop_test(tests, large_problems_hold_every_inequality, 0, share_of(2));
    tcase_add_loop_test(tests, a_letter_c_has_one_critical_point, 0, share_of(2));
    tcase_add_test(tests, bounds_without_room_are_refused);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
