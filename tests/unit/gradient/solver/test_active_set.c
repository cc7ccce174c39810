/* The tied problem by factorisation, the tree's inequalities, and Laplace's function under them.
 * Long double reaches down to 1e-4951, so that it can serve as a reference in long limbs, too. */
#include "base/error.h"
#include "gradient/grid/grassfire.h"
#include "gradient/solver/active_set.h"
#include "gradient/solver/inequalities.h"

#include "../../../faulty.h"
#include "../../../hard_masks.h"
#include "../../../random.h"
#include "../../../share.h"
#include "../../../suite.h"

#include <check.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DENSE = 90, MAX_MASK = 256 };

/* ------------------------------------------------------------- the problem */

typedef struct problem {
    iccp_env env;
    icc_tree *tree;
    iccp_unknowns unknowns;
    iccp_scaled f;
    uint32_t *top;
    double *share;
    uint32_t *order;
    iccp_ties ties;
} problem;

static problem problem_new(int32_t dim, const size_t *shape, const uint8_t *inside, uint32_t root)
{
    problem p;
    icc_grid *grid;
    ck_assert_int_eq(iccp_env_read(&p.env, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_grid_create_mask(&grid, dim, shape, inside, &p.env, NULL), ICC_OK);
    if (root == ICCP_NONE)
        ck_assert_int_eq(iccp_grassfire(grid, &root, NULL, &p.env, NULL), ICC_OK);
    ck_assert_int_eq(iccp_tree_create(&p.tree, grid, root, ICC_TREE_THESIS, NULL, &p.env, NULL),
                     ICC_OK);
    iccp_grid_release(grid);
    ck_assert_int_eq(iccp_unknowns_create(&p.unknowns, p.tree, &p.env), ICC_OK);
    const size_t n = p.unknowns.n;
    p.f = (iccp_scaled){malloc(n * sizeof(double)), malloc(n * sizeof(int32_t))};
    p.top = malloc(n * sizeof *p.top);
    p.share = malloc(n * sizeof *p.share);
    for (uint32_t k = 0; k < n; ++k) {
        p.top[k] = k;
        p.share[k] = 1;
        iccp_scaled_set(&p.f, k, 1, 0);
    }
    p.order = malloc(n * sizeof *p.order);
    p.order[0] = ICCP_NONE;
    p.ties = (iccp_ties){p.top, p.share, p.order};
    return p;
}

static void problem_free(problem *p)
{
    iccp_unknowns_free(&p->unknowns);
    iccp_tree_release(p->tree);
    free(p->f.fraction);
    free(p->f.exponent);
    free(p->top);
    free(p->share);
    free(p->order);
}

static problem problem_on(mask_shape shape, int32_t dim, size_t cells)
{
    mask m = mask_draw(shape, dim, cells);
    const problem p = problem_new(dim, m.shape, m.inside, ICCP_NONE);
    mask_free(&m);
    return p;
}

/* Three boxes, which meet in bays and corners, or scattered vertices. Returns the root. */
static uint32_t draw_randomly(random_source *r, int32_t dim, const size_t *shape, uint8_t *inside)
{
    size_t n = 1;
    for (int32_t k = 0; k < dim; ++k)
        n *= shape[k];
    const bool boxes = random_below(r, 2);
    const int density = 5 + random_below(r, 6);
    for (size_t v = 0; v < n; ++v)
        inside[v] = !boxes && random_below(r, 10) < density;
    uint32_t root = (uint32_t)random_below(r, (int)n);
    for (int box = 0; boxes && box < 3; ++box) {
        size_t low[ICC_MAX_DIM], high[ICC_MAX_DIM];
        for (int32_t k = 0; k < dim; ++k) {
            low[k] = (size_t)random_below(r, (int)shape[k]);
            high[k] = low[k] + (size_t)random_below(r, (int)(shape[k] - low[k]));
        }
        for (size_t v = 0; v < n; ++v) {
            bool within = true;
            for (size_t k = 0, rest = v; k < (size_t)dim; rest /= shape[k++])
                within = within && rest % shape[k] >= low[k] && rest % shape[k] <= high[k];
            if (!within)
                continue;
            inside[v] = 1;
            root = (uint32_t)v;
        }
    }
    inside[root] = 1;
    return root;
}

/* A coarse C, L, star or tube, from a random root. */
static problem coarse_problem(random_source *r)
{
    const mask_kind kind = mask_number((const int[]){2, 3, 4, 7}[random_below(r, 4)]);
    const int32_t dim = kind.dim == 0 ? 2 : kind.dim;
    for (;;) {
        mask m = mask_draw(kind.shape, dim, (size_t)(6 + random_below(r, 10)));
        uint32_t root;
        do
            root = (uint32_t)random_below(r, (int)m.n_vertices);
        while (m.inside[root] == 0);
        problem p = problem_new(dim, m.shape, m.inside, root);
        mask_free(&m);
        if (p.unknowns.n > 1 && p.unknowns.n <= MAX_DENSE)
            return p;
        problem_free(&p);
    }
}

/* 2 to MAX_DENSE rows. */
static problem random_problem(random_source *r, int32_t dim)
{
    const int largest[] = {0, 60, 16, 6, 4};
    for (;;) {
        uint8_t inside[MAX_MASK];
        size_t shape[ICC_MAX_DIM];
        for (int32_t k = 0; k < dim; ++k)
            shape[k] = (size_t)(2 + random_below(r, largest[dim] - 1));
        const uint32_t root = draw_randomly(r, dim, shape, inside);
        problem p = problem_new(dim, shape, inside, root);
        if (p.unknowns.n > 1 && p.unknowns.n <= MAX_DENSE)
            return p;
        problem_free(&p);
    }
}

static long double value(const iccp_scaled *f, size_t k)
{
    return ldexpl((long double)f->fraction[k], f->exponent[k]);
}

static long double laplacian(const problem *p, const long double *f, size_t k)
{
    const size_t degree = (size_t)p->unknowns.n_neighbours;
    long double sum = 0;
    for (size_t d = 0; d < degree; ++d) {
        const uint32_t j = p->unknowns.neighbour[k * degree + d];
        sum += f[k] - (j == ICCP_NONE ? 0 : f[j]);
    }
    return sum;
}

static long double *values(const problem *p)
{
    long double *f = malloc(p->unknowns.n * sizeof *f);
    for (size_t k = 0; k < p->unknowns.n; ++k)
        f[k] = value(&p->f, k);
    return f;
}

static long double energy(const problem *p, const long double *f)
{
    long double sum = 0;
    for (size_t k = 0; k < p->unknowns.n; ++k)
        sum += f[k] * laplacian(p, f, k);
    return sum;
}

static iccp_solution solve(problem *p)
{
    iccp_solution info = {0};
    ck_assert_int_eq(iccp_tied_direct(&p->unknowns, &p->ties, &p->f, &info, &p->env), ICC_OK);
    return info;
}

static iccp_solution constrain(problem *p, double eta)
{
    iccp_solution info = solve(p);
    ck_assert_int_eq(iccp_active_set_laplace(&p->unknowns, eta, iccp_tied_direct, p->order, &p->f,
                                             &info, &p->env),
                     ICC_OK);
    return info;
}

/* Ties some rows to their parents. */
static void tie_some(problem *p, random_source *r, double sigma, int tenths)
{
    for (uint32_t k = 1; k < p->unknowns.n; ++k) {
        const bool tied = random_below(r, 10) < tenths;
        p->top[k] = tied ? p->top[p->unknowns.parent[k]] : k;
        p->share[k] = tied ? p->share[p->unknowns.parent[k]] / sigma : 1;
    }
}

/* --------------------------------------------------------- tied by factors */

/* The dense P'LP by its definition, without rows of the root's cluster, and Gauss-Jordan. */
static void solve_densely(const problem *p, long double *f)
{
    static long double a[MAX_DENSE][MAX_DENSE + 1];
    const size_t n = p->unknowns.n, degree = (size_t)p->unknowns.n_neighbours;
    for (size_t t = 0; t < n; ++t)
        for (size_t s = 0; s <= n; ++s)
            a[t][s] = s == t && (p->top[t] != t || t == 0);
    a[0][n] = 1;
    for (size_t k = 0; k < n; ++k) {
        const uint32_t t = p->top[k];
        if (t == 0)
            continue;
        a[t][t] += (long double)degree * p->share[k] * p->share[k];
        for (size_t d = 0; d < degree; ++d) {
            const uint32_t j = p->unknowns.neighbour[k * degree + d];
            if (j != ICCP_NONE)
                a[t][p->top[j]] -= (long double)p->share[k] * p->share[j];
        }
    }
    for (size_t t = 0; t < n; ++t)
        for (size_t s = 0; s < n; ++s) {
            const long double factor = s == t ? 0 : a[s][t] / a[t][t];
            for (size_t c = t; factor < 0 && c <= n; ++c)
                a[s][c] -= factor * a[t][c];
        }
    for (size_t k = 0; k < n; ++k)
        f[k] = p->share[k] * a[p->top[k]][n] / a[p->top[k]][p->top[k]];
}

/* The order that is kept from the solution without ties never makes more work. */
START_TEST(factorisation_agrees_with_dense_elimination)
{
    random_source r = {1};
    long double f[MAX_DENSE];
    for (int round = 0; round < share_of(800); ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        const bool ordered = random_below(&r, 2);
        const double work = ordered ? solve(&p).work : HUGE_VAL;
        tie_some(&p, &r, 1 + random_between(&r, 0, 0.3), round % 11);
        ck_assert(solve(&p).work <= work);
        solve_densely(&p, f);
        for (size_t k = 0; k < p.unknowns.n; ++k)
            ck_assert(fabsl(value(&p.f, k) - f[k]) <= 1e-14L * f[k]);
        problem_free(&p);
    }
}
END_TEST

/* In a corridor one vertex wide: f_k = sinh(a (n - k)) / sinh(a n), cosh a = 2. */
START_TEST(small_components_are_right_to_the_last_digits)
{
    enum { N = 4000, WIDTH = N + 4 };
    uint8_t *inside = calloc(5 * WIDTH, 1);
    memset(inside + 2 * WIDTH + 2, 1, N);
    problem p = problem_new(2, (size_t[]){WIDTH, 5}, inside, 2 * WIDTH + 2);
    solve(&p);
    const long double q = 1 / (2 + sqrtl(3)); /* exp(-a) */
    long double power[2 * N + 1] = {1};
    for (size_t k = 0; k < 2 * N; ++k)
        power[k + 1] = q * power[k];
    for (size_t k = 0; k < N; ++k) {
        const long double exact = power[k] * (1 - power[2 * (N - k)]) / (1 - power[2 * N]);
        ck_assert(fabsl(value(&p.f, k) / exact - 1) < 1e-11L);
    }
    ck_assert_int_lt(p.f.exponent[N - 1], -7000);
    problem_free(&p);
    free(inside);
}
END_TEST

/* ------------------------------------------------------------- inequalities */

static void scatter(problem *p, random_source *r, int32_t exponents)
{
    for (size_t k = 0; k < p->unknowns.n; ++k)
        iccp_scaled_set(&p->f, k, random_between(r, 0.9, 1.1), -random_below(r, exponents));
}

/* As a caller would ask, in plain numbers. */
static size_t count_violated(const problem *p, double eta)
{
    size_t n = 0;
    for (size_t k = 1; k < p->unknowns.n; ++k) {
        const int32_t unit = p->f.exponent[p->unknowns.parent[k]];
        n += !(iccp_scaled_get(&p->f, p->unknowns.parent[k], unit) >=
               (1 + eta) * iccp_scaled_get(&p->f, k, unit));
    }
    return n;
}

START_TEST(nothing_is_violated_after_a_sweep)
{
    random_source r = {2};
    const double etas[] = {1e-12, 1e-6, 1e-3, 0.01};
    for (int round = 0; round < share_of(1000); ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        const double eta = etas[random_below(&r, 4)];
        scatter(&p, &r, round % 2 == 0 ? 1 : 3000);
        ck_assert_uint_eq(iccp_inequalities_violated(&p.unknowns, eta, &p.f),
                          count_violated(&p, eta));
        long double *before = values(&p);
        iccp_inequalities_sweep(&p.unknowns, eta, &p.f);
        ck_assert_uint_eq(iccp_inequalities_violated(&p.unknowns, eta, &p.f), 0);
        ck_assert_uint_eq(count_violated(&p, eta), 0);
        for (size_t k = 1; k < p.unknowns.n; ++k) { /* min(f_k, f_parent / sigma) */
            const long double most = value(&p.f, p.unknowns.parent[k]) / (1 + (long double)eta);
            ck_assert(fabsl(value(&p.f, k) / fminl(before[k], most) - 1) < 1e-15L);
            ck_assert(value(&p.f, k) <= before[k]);
        }
        free(before);
        problem_free(&p);
    }
}
END_TEST

/* lambda_k by its definition, a sum over all rows below k, and the largest |min(slack, lambda)|
 * with slack and lambda in units of f_k if `relative`. */
static long double residual(const problem *p, const long double *f, long double eta, bool relative)
{
    long double *lambda = calloc(p->unknowns.n, sizeof *lambda), largest = 0;
    for (uint32_t j = 1; j < p->unknowns.n; ++j) {
        long double share = -laplacian(p, f, j) / (1 + eta);
        for (uint32_t k = j; k != 0 && fabsl(share) > 0;
             k = p->unknowns.parent[k], share /= 1 + eta)
            lambda[k] += share;
    }
    for (size_t k = 1; k < p->unknowns.n; ++k) {
        const long double slack = f[p->unknowns.parent[k]] - (1 + eta) * f[k];
        const long double r = fabsl(fminl(slack, lambda[k]));
        largest = fmaxl(largest, relative ? r / f[k] : r);
    }
    free(lambda);
    return largest;
}

START_TEST(residual_is_that_of_the_definition)
{
    random_source r = {3};
    for (int round = 0; round < share_of(500); ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        const double eta = random_between(&r, 1e-6, 0.01);
        scatter(&p, &r, 3);
        double gradient[MAX_DENSE], fraction[MAX_DENSE], work[2 * MAX_DENSE];
        for (size_t k = 0; k < p.unknowns.n; ++k) {
            gradient[k] = iccp_laplacian_row(&p.unknowns, &p.f, k, 0);
            fraction[k] = (double)value(&p.f, k);
        }
        const iccp_scaled g = {gradient, NULL}, plain = {fraction, NULL};
        long double *f = values(&p);
        const double found = iccp_inequalities_residual(&p.unknowns, eta, 0, &p.f, &g, work);
        const double found_plain =
            iccp_inequalities_residual(&p.unknowns, eta, 0, &plain, &g, work);
        ck_assert(fabsl(found - residual(&p, f, eta, false)) < 1e-13L);
        ck_assert(found >= found_plain && found <= found_plain);
        free(f);
        problem_free(&p);
    }
}
END_TEST

/* A point that is optimal by construction: slacks and multipliers are drawn so that one of each
 * pair is 0, and the gradient follows. Often both a leaf's edge and its bound are tight. */
START_TEST(residual_with_bounds_at_leaves)
{
    random_source r = {4};
    const double sigma = 1.01, leaf = 1e-3;
    for (int round = 0; round < share_of(2000); ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        const size_t n = p.unknowns.n;
        double f[MAX_DENSE], gradient[MAX_DENSE] = {0}, work[2 * MAX_DENSE];
        double lambda[MAX_DENSE] = {0};
        bool has_child[MAX_DENSE] = {false};
        for (size_t k = 1; k < n; ++k)
            has_child[p.unknowns.parent[k]] = true;
        for (size_t k = n; k-- > 0;) { /* upwards: slacks */
            f[k] = has_child[k] ? 0 : leaf * (random_below(&r, 2) ? 1 : 2);
            for (size_t c = k + 1; c < n; ++c)
                if (p.unknowns.parent[c] == k)
                    f[k] = fmax(f[k], sigma * f[c]);
            if (random_below(&r, 3) == 0)
                f[k] += random_unit(&r);
        }
        for (size_t k = 1; k < n; ++k) {
            const bool tight = f[p.unknowns.parent[k]] - sigma * f[k] < 1e-12;
            lambda[k] = tight && random_below(&r, 3) > 0 ? random_unit(&r) : 0;
            gradient[k] -= sigma * lambda[k];
            gradient[p.unknowns.parent[k]] += lambda[k];
            if (!has_child[k] && f[k] < leaf * 1.5 && random_below(&r, 3) > 0)
                gradient[k] += random_unit(&r);
        }
        const iccp_scaled x = {f, NULL}, g = {gradient, NULL};
        ck_assert(iccp_inequalities_residual(&p.unknowns, sigma - 1, leaf, &x, &g, work) < 1e-12);
        const size_t k = 1 + (size_t)random_below(&r, (int)n - 1);
        if (f[p.unknowns.parent[k]] - sigma * f[k] > 1e-2 && f[k] > leaf + 1e-2 && !has_child[k]) {
            gradient[k] = 1e-3; /* nothing that is tight can hold this */
            ck_assert(iccp_inequalities_residual(&p.unknowns, sigma - 1, leaf, &x, &g, work) >
                      9e-4);
        }
        f[k] = -1; /* below the bound, or its child's */
        ck_assert(iccp_inequalities_residual(&p.unknowns, sigma - 1, leaf, &x, &g, work) > 1e-3);
        problem_free(&p);
    }
}
END_TEST

/* -------------------------------------------------------------- constrained */

/* The least energy by cyclic minimisation along one slack after the other: raising the slack of
 * edge k lowers all rows below it. Slow and safe; `f` is the result. */
static void minimise_slowly(const problem *p, long double eta, long double *f)
{
    static long double direction[MAX_DENSE][MAX_DENSE], image[MAX_DENSE][MAX_DENSE];
    long double slack[MAX_DENSE] = {0}, step = 1;
    const size_t n = p->unknowns.n;
    f[0] = 1;
    for (size_t k = 1; k < n; ++k)
        f[k] = f[p->unknowns.parent[k]] / (1 + eta);
    for (size_t k = 1; k < n; ++k) {
        memset(direction[k], 0, sizeof direction[k]);
        direction[k][k] = -1 / (1 + eta);
        for (size_t j = k + 1; j < n; ++j)
            direction[k][j] = direction[k][p->unknowns.parent[j]] / (1 + eta);
        for (size_t j = 0; j < n; ++j)
            image[k][j] = laplacian(p, direction[k], j);
    }
    for (int round = 0; round < 200000 && step > 1e-17L; ++round) {
        step = 0;
        for (size_t k = 1; k < n; ++k) {
            long double slope = 0, curvature = 0;
            for (size_t j = 0; j < n; ++j) {
                slope += image[k][j] * f[j];
                curvature += image[k][j] * direction[k][j];
            }
            const long double x = fmaxl(-slack[k], -slope / curvature);
            slack[k] += x;
            step = fmaxl(step, fabsl(x));
            for (size_t j = k; j < n; ++j)
                f[j] += x * direction[k][j];
        }
    }
    ck_assert(step <= 1e-17L);
}

START_TEST(energy_is_the_least)
{
    random_source r = {5};
    const double etas[] = {1e-6, 0.01, 0.3};
    size_t n_active = 0;
    for (int round = 0; round < 300; ++round) {
        problem p = round % 2 == 0 ? coarse_problem(&r) : random_problem(&r, 2 + round % 3);
        const double eta = etas[random_below(&r, 3)];
        long double best[MAX_DENSE];
        const iccp_solution info = constrain(&p, eta);
        long double *f = values(&p);
        minimise_slowly(&p, eta, best);
        ck_assert(energy(&p, f) <= energy(&p, best) * (1 + 1e-13L));
        for (size_t k = 0; k < p.unknowns.n; ++k)
            ck_assert(fabsl(f[k] - best[k]) < 1e-9L);
        ck_assert(info.residual_before < 1e-13 && info.residual < 1e-12);
        ck_assert(residual(&p, f, eta, true) < 1e-12L);
        ck_assert_uint_eq(count_violated(&p, eta), 0);
        ck_assert_uint_ge(info.n_iterations, info.n_violated > 0);
        n_active += info.n_active;
        free(f);
        problem_free(&p);
    }
    ck_assert_uint_gt(n_active, 500);
}
END_TEST

START_TEST(hard_masks)
{
    for (int i = 0; i < N_MASKS; ++i) {
        const mask_kind kind = mask_number(i);
        const int32_t dim = kind.dim == 0 ? 2 : kind.dim;
        problem p = problem_on(kind.shape, dim, dim == 2 ? 100 : 24);
        for (double eta = 1e-9; eta < 0.02; eta *= 1e7 / (eta < 1e-8 ? 1e4 : 1e3)) {
            const iccp_solution info = constrain(&p, eta);
            long double *f = values(&p);
            ck_assert_msg(residual(&p, f, eta, false) < 1e-12L, "%s", kind.name);
            ck_assert(info.residual < 1e-12 && info.residual_before < 1e-12);
            ck_assert_uint_eq(count_violated(&p, eta), 0);
            ck_assert_uint_le(info.n_iterations, 20);
            free(f);
        }
        problem_free(&p);
    }
}
END_TEST

/* Values down to 1e-300 and far below: every limb is as good as the neighbourhood of the root. */
START_TEST(serpentine_beyond_the_range_of_double)
{
    problem p = problem_on(mask_serpentine, 2, 500);
    const iccp_solution info = constrain(&p, 1e-6);
    long double *f = values(&p);
    int32_t least = 0;
    for (size_t k = 0; k < p.unknowns.n; ++k)
        least = p.f.exponent[k] < least ? p.f.exponent[k] : least;
    ck_assert_int_lt(least, -1100);
    ck_assert(info.n_active > p.unknowns.n / 100 && info.n_active < p.unknowns.n / 4);
    ck_assert(residual(&p, f, 1e-6L, true) < 1e-11L);
    ck_assert_uint_eq(count_violated(&p, 1e-6), 0);
    free(f);
    problem_free(&p);
}
END_TEST

START_TEST(c_200_does_not_cycle)
{
    problem p = problem_on(mask_c, 2, 200);
    for (double eta = 1e-10; eta < 0.02; eta *= 100) {
        const iccp_solution info = constrain(&p, eta);
        ck_assert_uint_le(info.n_iterations, 12);
        ck_assert(info.residual < 1e-12);
    }
    problem_free(&p);
}
END_TEST

/* ---------------------------------------------------------- when things fail */

/* Never converges. */
static icc_status solve_randomly(const iccp_unknowns *unknowns, const iccp_ties *ties,
                                 const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    random_source r = {++info->n_inner};
    (void)env;
    for (size_t k = 0; k < unknowns->n; ++k)
        iccp_scaled_set(f, k, ties->share[k] * random_between(&r, 0.5, 1), 0);
    return ICC_OK;
}

/* Right to 11 digits. */
static icc_status solve_roughly(const iccp_unknowns *unknowns, const iccp_ties *ties,
                                const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    random_source r = {++info->n_inner};
    const icc_status status = iccp_tied_direct(unknowns, ties, f, info, env);
    for (size_t k = 0; status == ICC_OK && k < unknowns->n; ++k)
        if (ties->top[k] == k && k > 0)
            iccp_scaled_set(f, k, f->fraction[k] * (1 + random_between(&r, -1e-11, 1e-11)),
                            f->exponent[k]);
    for (size_t k = 0; status == ICC_OK && k < unknowns->n; ++k)
        iccp_scaled_set(f, k, f->fraction[ties->top[k]] * ties->share[k],
                        f->exponent[ties->top[k]]);
    return status;
}

/* Everything is as high as the root. */
static icc_status solve_flatly(const iccp_unknowns *unknowns, const iccp_ties *ties,
                               const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    (void)ties, (void)info, (void)env;
    for (size_t k = 0; k < unknowns->n; ++k)
        iccp_scaled_set(f, k, 1, 0);
    return ICC_OK;
}

START_TEST(back_ends_that_do_not_converge)
{
    problem p = problem_on(mask_c, 2, 20);
    iccp_solution info = {0};
    ck_assert_int_eq(
        iccp_active_set_laplace(&p.unknowns, 1e-6, solve_randomly, NULL, &p.f, &info, &p.env),
        ICC_ERR_SOLVER);
    ck_assert_uint_eq(info.n_iterations, info.n_inner);
    info = solve(&p);
    ck_assert_int_eq(
        iccp_active_set_laplace(&p.unknowns, 1e-6, solve_roughly, p.order, &p.f, &info, &p.env),
        ICC_OK);
    ck_assert(info.n_iterations < 40 && info.residual < 1e-9);
    ck_assert_uint_eq(count_violated(&p, 1e-6), 0);
    problem_free(&p);
}
END_TEST

START_TEST(chains_too_long_for_their_shares)
{
    enum { N = 30000 };
    uint8_t *inside = malloc(N);
    memset(inside, 1, N);
    problem p = problem_new(1, (size_t[]){N}, inside, 0);
    iccp_solution info = {0};
    ck_assert_int_eq(
        iccp_active_set_laplace(&p.unknowns, 0.01, solve_flatly, NULL, &p.f, &info, &p.env),
        ICC_ERR_SOLVER);
    ck_assert_uint_eq(info.n_iterations, 0);
    problem_free(&p);
    free(inside);
}
END_TEST

static icc_status call_constrained(const icc_env *env, icc_error *err, void *argument)
{
    problem *p = argument;
    iccp_env inner;
    iccp_solution info = {0};
    ck_assert_int_eq(iccp_env_read(&inner, env, err), ICC_OK);
    p->order[0] = ICCP_NONE;
    icc_status status = iccp_tied_direct(&p->unknowns, &p->ties, &p->f, &info, &inner);
    if (status == ICC_OK)
        status = iccp_active_set_laplace(&p->unknowns, 1e-6, iccp_tied_direct, p->order, &p->f,
                                         &info, &inner);
    return iccp_explain(err, status);
}

START_TEST(every_allocation_and_every_report_may_fail)
{
    problem p = problem_on(mask_c, 2, 24);
    faulty_sweep(call_constrained, &p);
    problem_free(&p);
}
END_TEST

START_TEST(root_alone)
{
    const uint8_t inside[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0};
    problem p = problem_new(2, (size_t[]){3, 3}, inside, 4);
    const iccp_solution info = constrain(&p, 1e-6);
    ck_assert(value(&p.f, 0) >= 1 && value(&p.f, 0) <= 1);
    ck_assert(info.n_iterations == 0 && info.residual <= 0);
    problem_free(&p);
}
END_TEST

int main(void)
{
    TCase *tcase = tcase_create("constrained");
    tcase_add_test(tcase, factorisation_agrees_with_dense_elimination);
    tcase_add_test(tcase, small_components_are_right_to_the_last_digits);
    tcase_add_test(tcase, nothing_is_violated_after_a_sweep);
    tcase_add_test(tcase, residual_is_that_of_the_definition);
    tcase_add_test(tcase, residual_with_bounds_at_leaves);
    tcase_add_test(tcase, energy_is_the_least);
    tcase_add_test(tcase, hard_masks);
    tcase_add_test(tcase, serpentine_beyond_the_range_of_double);
    tcase_add_test(tcase, c_200_does_not_cycle);
    tcase_add_test(tcase, back_ends_that_do_not_converge);
    tcase_add_test(tcase, chains_too_long_for_their_shares);
    tcase_add_test(tcase, every_allocation_and_every_report_may_fail);
    tcase_add_test(tcase, root_alone);
    Suite *suite = suite_create("constrained");
    suite_add_tcase(suite, tcase);
    return suite_run(suite);
}
