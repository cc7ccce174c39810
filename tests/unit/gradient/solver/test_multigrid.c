/* The V-cycle as a preconditioner, and the iterative solver of the tied problem against dense
 * elimination and the direct one. */
#include "base/error.h"
#include "gradient/solver/mg_cg.h"
#include "gradient/solver/tied.h"

#include "../../../default_env.h"
#include "../../../faulty.h"
#include "../../../hard_masks.h"
#include "../../../random.h"
#include "../../../share.h"
#include "../../../suite.h"

#include <check.h>
#include <string.h>

/* Largest problems for dense elimination. */
enum { DENSE = 400 };

/* A grid with its tree, and everything that a solver wants. */
typedef struct problem {
    icc_grid *grid;
    icc_tree *tree;
    iccp_unknowns unknowns;
    uint32_t *top;
    double *share;
    iccp_scaled f;
} problem;

static problem problem_of(int32_t dim, const size_t *shape, const uint8_t *inside, uint32_t root)
{
    const iccp_env env = default_env();
    problem p;
    ck_assert_int_eq(icc_grid_create_mask(&p.grid, dim, shape, inside, NULL, NULL), ICC_OK);
    if (root == ICCP_NONE)
        ck_assert_int_eq(icc_grid_find_maximum(p.grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&p.tree, p.grid, root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(iccp_unknowns_create(&p.unknowns, p.tree, &env), ICC_OK);
    p.top = malloc(p.unknowns.n * sizeof *p.top);
    p.share = malloc(p.unknowns.n * sizeof *p.share);
    p.f = (iccp_scaled){malloc(p.unknowns.n * sizeof(double)),
                        malloc(p.unknowns.n * sizeof(int32_t))};
    for (uint32_t k = 0; k < p.unknowns.n; ++k) {
        p.top[k] = k;
        p.share[k] = 1;
        iccp_scaled_set(&p.f, k, 1, 0);
    }
    return p;
}

static void problem_clear(problem *p)
{
    free(p->top);
    free(p->share);
    free(p->f.fraction);
    free(p->f.exponent);
    iccp_unknowns_free(&p->unknowns);
    icc_tree_free(p->tree);
    icc_grid_free(p->grid);
}

/* The masks of every kind, and those with limbs that differ most. */
enum { N_KINDS = N_MASKS + 2 };

static mask_kind kind_number(int k)
{
    const mask_kind more[2] = {{"two ways", 2, mask_two_ways}, {"comb", 2, mask_comb}};
    return k < N_MASKS ? mask_number(k) : more[k - N_MASKS];
}

static problem drawn(mask_shape shape, int32_t dim, size_t cells)
{
    mask m = mask_draw(shape, dim, cells);
    const problem p = problem_of(dim, m.shape, m.inside, ICCP_NONE);
    mask_free(&m);
    return p;
}

/* Any vertices of a small box, up to its rim. */
static problem scattered(random_source *r, int32_t dim)
{
    uint8_t inside[DENSE] = {0};
    size_t shape[ICC_MAX_DIM], n = 1;
    const int most[ICC_MAX_DIM] = {100, 20, 7, 4, 3, 2};
    for (int32_t k = 0; k < dim; ++k)
        n *= shape[k] = (size_t)(1 + random_below(r, most[dim - 1]));
    const int density = 5 + random_below(r, 6);
    for (size_t v = 0; v < n; ++v)
        inside[v] = random_below(r, 10) < density;
    const uint32_t root = (uint32_t)random_below(r, (int)n);
    inside[root] = 1;
    return problem_of(dim, shape, inside, root);
}

/* Ties rows to their parents at random. */
static void tie(problem *p, random_source *r, int percent, double least_share)
{
    for (uint32_t k = 1; k < p->unknowns.n; ++k)
        if (random_below(r, 100) < percent) {
            const uint32_t parent = p->unknowns.parent[k];
            p->top[k] = p->top[parent];
            p->share[k] = p->share[parent] * random_between(r, least_share, 1);
        }
}

static icc_status solve(problem *p, size_t *n_inner)
{
    const iccp_env env = default_env();
    iccp_solution info = {0};
    const iccp_ties ties = {.top = p->top, .share = p->share};
    const icc_status status = iccp_tied_iterative(&p->unknowns, &ties, &p->f, &info, &env);
    if (n_inner != NULL)
        *n_inner = info.n_inner;
    return status;
}

/* ---------------------------------------------------------------- the kernels */

enum { LONGEST = 70, FLOATS = LONGEST + 8 };

/* What all kernels of a set make of the same numbers. */
typedef struct outcome {
    float x[FLOATS], sum[FLOATS], p[FLOATS], b[FLOATS];
    double y[FLOATS], r[FLOATS];
    iccp_mg_upward up;
    iccp_mg_downward down;
} outcome;

static void run_kernels(const iccp_mg_kernels *kernels, size_t n, int32_t n_near, uint64_t seed,
                        outcome *o)
{
    random_source r = {seed};
    float vector[2 * ICC_MAX_DIM][FLOATS];
    const float *near[2 * ICC_MAX_DIM];
    memset(o, 0, sizeof *o);
    for (int32_t j = 0; j < 2 * ICC_MAX_DIM; ++j)
        for (size_t i = 0; i < FLOATS; ++i)
            vector[j][i] = (float)random_between(&r, -1, 1);
    for (int32_t j = 0; j < n_near; ++j)
        near[j] = vector[j] + random_below(&r, 8);
    for (size_t i = 0; i < FLOATS; ++i) {
        o->p[i] = (float)random_between(&r, -1, 1);
        o->y[i] = random_between(&r, -1, 1);
        o->r[i] = random_between(&r, -1, 1);
    }
    kernels->relax(o->x, vector[11], vector[10], near, n, n_near);
    kernels->add(o->sum, near, n, n_near);
    kernels->redirect(o->p, vector[9], 0.7f, n);
    kernels->measure(vector[8], o->r, near, n, n_near, &o->up);
    const iccp_mg_step step = {o->y, o->r, o->b, o->p, 0.3, 1e-3, 0.1};
    kernels->advance(&step, near, n, n_near, &o->down);
}

/* On every machine and for any length. */
START_TEST(kernels_agree_to_the_bit)
{
    for (int32_t n_near = 4; n_near <= 6; n_near += 2)
        for (size_t n = 0; n <= LONGEST; ++n) {
            outcome fast, portable;
            run_kernels(iccp_mg_kernels_choose(n_near, false), n, n_near, n, &fast);
            run_kernels(iccp_mg_kernels_choose(n_near, true), n, n_near, n, &portable);
            ck_assert(memcmp(&fast, &portable, sizeof fast) == 0);
            ck_assert(fast.x[n] >= 0 && fast.x[n] <= 0);
        }
}
END_TEST

/* ------------------------------------------------------------ what is solved */

/* P'LP densely: n * n, 0 in the rows and columns of members but for 1 on their diagonal. */
static double *dense_matrix(const problem *p)
{
    const size_t n = p->unknowns.n, degree = (size_t)p->unknowns.n_neighbours;
    double *a = calloc(n * n, sizeof *a);
    for (size_t k = 0; k < n; ++k) {
        a[p->top[k] * n + p->top[k]] += (double)degree * p->share[k] * p->share[k];
        for (size_t d = 0; d < degree; ++d) {
            const uint32_t j = p->unknowns.neighbour[k * degree + d];
            if (j != ICCP_NONE)
                a[p->top[k] * n + p->top[j]] -= p->share[k] * p->share[j];
        }
        if (p->top[k] != k)
            a[k * n + k] = 1;
    }
    return a;
}

/* Gaussian elimination without pivoting: the matrix is an M-matrix. */
static void eliminate(size_t n, double *a, double *b)
{
    for (size_t k = 0; k < n; ++k)
        for (size_t i = k + 1; i < n; ++i) {
            const double factor = a[i * n + k] / a[k * n + k];
            for (size_t j = k; j < n && (factor < 0 || factor > 0); ++j)
                a[i * n + j] -= factor * a[k * n + j];
            b[i] -= factor * b[k];
        }
    for (size_t k = n; k-- > 0;) {
        for (size_t j = k + 1; j < n; ++j)
            b[k] -= a[k * n + j] * b[j];
        b[k] /= a[k * n + k];
    }
}

static double *dense_solution(const problem *p)
{
    const size_t n = p->unknowns.n;
    double *a = dense_matrix(p), *b = calloc(n, sizeof *b);
    memset(a, 0, n * sizeof *a);
    a[0] = b[0] = 1;
    eliminate(n, a, b);
    for (size_t k = n; k-- > 0;)
        b[k] = p->share[k] * b[p->top[k]];
    free(a);
    return b;
}

/* Row k of P'LP f, for every top, in units of its terms: the worst. */
static double residual(const problem *p)
{
    const size_t n = p->unknowns.n, degree = (size_t)p->unknowns.n_neighbours;
    double *sum = calloc(n, sizeof *sum), *size = calloc(n, sizeof *size), worst = 0;
    for (size_t k = 0; k < n; ++k) {
        const uint32_t t = p->top[k];
        for (size_t d = 0; d < degree; ++d) {
            const uint32_t j = p->unknowns.neighbour[k * degree + d];
            const double own = p->share[k] * iccp_scaled_get(&p->f, k, p->f.exponent[t]);
            const double other =
                j == ICCP_NONE ? 0 : p->share[k] * iccp_scaled_get(&p->f, j, p->f.exponent[t]);
            sum[t] += own - other;
            size[t] += own + other;
        }
    }
    for (size_t k = 1; k < n; ++k)
        if (p->top[k] == k)
            worst = fmax(worst, fabs(sum[k]) / size[k]);
    free(sum);
    free(size);
    return worst;
}

/* Positive, normalised, 1 at the root, members in their share. */
static void check_form(const problem *p)
{
    for (uint32_t k = 0; k < p->unknowns.n; ++k) {
        ck_assert(p->f.fraction[k] >= 0.5 && p->f.fraction[k] < 1);
        const double wanted = p->share[k] * iccp_scaled_get(&p->f, p->top[k], p->f.exponent[k]);
        ck_assert_double_eq_tol(wanted, p->f.fraction[k], 1e-14);
    }
    ck_assert_double_eq_tol(iccp_scaled_get(&p->f, 0, 0), 1, 1e-14);
}

/* Vertices other than the root without a neighbour that is at least as high. */
static size_t false_maxima(const problem *p)
{
    size_t count = 0;
    for (uint32_t k = 1; k < p->unknowns.n; ++k) {
        bool has_higher = false;
        for (int32_t d = 0; d < p->unknowns.n_neighbours; ++d) {
            const uint32_t j =
                p->unknowns.neighbour[k * (size_t)p->unknowns.n_neighbours + (size_t)d];
            has_higher = has_higher || (j != ICCP_NONE && iccp_scaled_compare(&p->f, j, k) >= 0);
        }
        count += !has_higher;
    }
    return count;
}

/* The largest relative difference. */
static double difference(const problem *p, const iccp_scaled *g)
{
    double worst = 0;
    for (size_t k = 0; k < p->unknowns.n; ++k) {
        const double f = p->f.fraction[k];
        worst = fmax(worst, fabs(iccp_scaled_get(g, k, p->f.exponent[k]) / f - 1));
    }
    return worst;
}

/* --------------------------------------------------------------- the V-cycle */

static void cycle(iccp_multigrid *mg, const double *b, double *x)
{
    const iccp_mg_level *level = &mg->level[0];
    for (size_t i = 0; i < level->n_entries; ++i)
        level->b[i] = (float)b[i];
    iccp_multigrid_cycle(mg);
    for (size_t i = 0; i < level->n_entries; ++i)
        x[i] = (double)level->x[i];
}

static double dot(size_t n, const double *a, const double *b)
{
    double sum = 0;
    for (size_t i = 0; i < n; ++i)
        sum += a[i] * b[i];
    return sum;
}

static void fill_inside(size_t n, const uint32_t *position, size_t n_entries, random_source *r,
                        double *b)
{
    memset(b, 0, n_entries * sizeof *b);
    for (size_t k = 0; k < n; ++k)
        b[position[k]] = random_between(r, -1, 1);
}

static void check_cycle(const problem *p, random_source *r)
{
    const iccp_env env = default_env();
    const size_t n_inside = p->unknowns.n;
    iccp_multigrid mg;
    uint32_t *position = malloc(n_inside * sizeof *position);
    ck_assert_ptr_nonnull(position);
    ck_assert_int_eq(
        iccp_multigrid_create(&mg, p->grid, n_inside, p->unknowns.vertex, position, &env), ICC_OK);
    const size_t n = mg.level[0].n_entries;
    ck_assert_uint_eq(mg.level[0].n_inside, p->unknowns.n);
    double *b = malloc(4 * n * sizeof *b), *c = b + n, *x = c + n, *y = x + n;
    fill_inside(n_inside, position, n, r, b);
    fill_inside(n_inside, position, n, r, c);
    cycle(&mg, b, x);
    cycle(&mg, c, y);
    ck_assert_double_gt(dot(n, b, x), 0);
    ck_assert_double_gt(dot(n, c, y), 0);
    const double size = sqrt(dot(n, x, x) * dot(n, c, c)) + sqrt(dot(n, y, y) * dot(n, b, b));
    ck_assert_double_eq_tol(dot(n, c, x), dot(n, b, y), 1e-6 * size);
    /* Nothing outside, and nothing left from the cycle before. */
    cycle(&mg, b, y);
    ck_assert(memcmp(x, y, n * sizeof *x) == 0);
    size_t n_positions = 0;
    for (size_t i = 0; i < n; ++i)
        n_positions += x[i] < 0 || x[i] > 0;
    ck_assert_uint_le(n_positions, p->unknowns.n);
    free(position);
    free(b);
    iccp_multigrid_free(&mg);
}

START_TEST(cycle_is_symmetric_positive_definite)
{
    random_source r = {1};
    for (int32_t dim = 1; dim <= ICC_MAX_DIM; ++dim)
        for (int trial = 0; trial < 40; ++trial) {
            problem p = scattered(&r, dim);
            check_cycle(&p, &r);
            problem_clear(&p);
        }
    for (int k = 0; k < N_KINDS; ++k) {
        const mask_kind kind = kind_number(k);
        problem p = drawn(kind.shape, kind.dim == 3 ? 3 : 2, kind.dim == 3 ? 24 : 70);
        check_cycle(&p, &r);
        problem_clear(&p);
    }
}
END_TEST

/* x = 1 at the middle vertex of a list, in how many iterations? */
static size_t count_iterations(const problem *p)
{
    const iccp_env env = default_env();
    const iccp_mg_goal goal = {1e-10, 1e300, 1};
    iccp_multigrid mg;
    uint32_t *position = malloc(p->unknowns.n * sizeof *position);
    ck_assert_ptr_nonnull(position);
    ck_assert_int_eq(
        iccp_multigrid_create(&mg, p->grid, p->unknowns.n, p->unknowns.vertex, position, &env),
        ICC_OK);
    const iccp_mg_level *level = &mg.level[0];
    double *x = calloc(level->n_entries, sizeof *x), *r = calloc(level->n_entries, sizeof *r);
    r[position[p->unknowns.n / 2]] = 1;
    free(position);
    size_t n = 0;
    ck_assert_int_eq(iccp_mg_cg(&mg, x, r, 1, &goal, &n, &env), ICC_OK);
    free(x);
    free(r);
    iccp_multigrid_free(&mg);
    return n;
}

/* On every mask, thin walls and corridors that coarse levels cannot see included. */
START_TEST(iterations_do_not_grow)
{
    for (int k = 0; k < N_KINDS; ++k) {
        const mask_kind kind = kind_number(k);
        for (int32_t dim = 2; dim <= 4; ++dim) {
            if (kind.dim != 0 && kind.dim != dim)
                continue;
            const size_t cells[5][2] = {{0, 0}, {0, 0}, {81, 400}, {20, 57}, {7, 13}};
            for (int i = 0; i < 2; ++i) {
                problem p = drawn(kind.shape, dim, cells[dim][i]);
                const size_t n = count_iterations(&p);
                ck_assert_msg(n <= 16, "%s %d-D %zu: %zu iterations", kind.name, dim, cells[dim][i],
                              n);
                problem_clear(&p);
            }
        }
    }
}
END_TEST

/* ------------------------------------------------------------------ solutions */

static void check_dense(problem *p)
{
    ck_assert_int_eq(solve(p, NULL), ICC_OK);
    check_form(p);
    double *wanted = dense_solution(p);
    for (size_t k = 0; k < p->unknowns.n; ++k) {
        const double f = iccp_scaled_get(&p->f, k, 0);
        ck_assert_double_eq_tol(f / wanted[k], 1, 1e-7);
    }
    ck_assert_double_le(residual(p), 1e-8);
    free(wanted);
}

START_TEST(plain_agrees_with_elimination)
{
    random_source r = {2};
    for (int32_t dim = 1; dim <= ICC_MAX_DIM; ++dim)
        for (int trial = 0; trial < 30; ++trial) {
            problem p = scattered(&r, dim);
            check_dense(&p);
            ck_assert_uint_eq(false_maxima(&p), 0);
            problem_clear(&p);
        }
}
END_TEST

START_TEST(tied_agrees_with_elimination)
{
    random_source r = {3};
    for (int32_t dim = 1; dim <= 4; ++dim)
        for (int trial = 0; trial < share_of(60); ++trial) {
            problem p = scattered(&r, dim);
            const int percent[4] = {5, 30, 60, 100};
            tie(&p, &r, percent[trial % 4], trial % 3 == 0 ? 0.999999 : 0.5);
            check_dense(&p);
            problem_clear(&p);
        }
}
END_TEST

static void check_direct(const problem *p)
{
    const iccp_env env = default_env();
    const iccp_scaled g = {malloc(p->unknowns.n * sizeof(double)),
                           malloc(p->unknowns.n * sizeof(int32_t))};
    const iccp_ties ties = {.top = p->top, .share = p->share};
    iccp_solution info = {0};
    if (iccp_tied_direct(&p->unknowns, &ties, &g, &info, &env) == ICC_OK)
        ck_assert_double_le(difference(p, &g), 1e-6);
    free(g.fraction);
    free(g.exponent);
}

START_TEST(every_mask_is_solved)
{
    for (int k = 0; k < N_KINDS; ++k) {
        const mask_kind kind = kind_number(k);
        problem p = drawn(kind.shape, kind.dim == 3 ? 3 : 2, kind.dim == 3 ? 24 : 150);
        ck_assert_int_eq(solve(&p, NULL), ICC_OK);
        check_form(&p);
        ck_assert_double_le(residual(&p), 1e-8);
        ck_assert_uint_eq(false_maxima(&p), 0);
        check_direct(&p);
        problem_clear(&p);
    }
}
END_TEST

/* A corridor 111 times as long as wide: values down to 1e-69 in the middle of the root's two ways,
 * or 1e-133 from one end. */
START_TEST(decay_is_followed)
{
    mask m = mask_draw(mask_serpentine, 2, 200);
    for (int from_end = 0; from_end < 2; ++from_end) {
        const uint32_t end = (uint32_t)(8 + MASK_MARGIN + (8 + MASK_MARGIN) * m.shape[0]);
        problem p = problem_of(2, m.shape, m.inside, from_end ? end : ICCP_NONE);
        ck_assert_int_eq(solve(&p, NULL), ICC_OK);
        ck_assert_double_le(residual(&p), 1e-8);
        ck_assert_uint_eq(false_maxima(&p), 0);
        int32_t least = 0;
        for (size_t k = 0; k < p.unknowns.n; ++k)
            least = p.f.exponent[k] < least ? p.f.exponent[k] : least;
        ck_assert_int_lt(least, from_end ? -430 : -210);
        check_direct(&p);
        problem_clear(&p);
    }
    mask_free(&m);
}
END_TEST

/* The same with a tenth of the rows tied, as by the inequalities. */
START_TEST(tied_decay_is_followed)
{
    random_source r = {4};
    for (int k = 0; k < N_KINDS; ++k) {
        const mask_kind kind = kind_number(k);
        problem p = drawn(kind.shape, kind.dim == 3 ? 3 : 2, kind.dim == 3 ? 22 : 100);
        tie(&p, &r, 10, 0.999999);
        ck_assert_int_eq(solve(&p, NULL), ICC_OK);
        check_form(&p);
        ck_assert_double_le(residual(&p), 1e-8);
        check_direct(&p);
        problem_clear(&p);
    }
}
END_TEST

START_TEST(good_guess_saves_iterations)
{
    size_t cold, warm;
    problem p = drawn(mask_c, 2, 150);
    random_source r = {5};
    tie(&p, &r, 5, 0.999999);
    ck_assert_int_eq(solve(&p, &cold), ICC_OK);
    ck_assert_int_eq(solve(&p, &warm), ICC_OK);
    ck_assert_uint_lt(3 * warm, cold);
    problem_clear(&p);
}
END_TEST

START_TEST(smallest_problems)
{
    const uint8_t inside[9] = {0, 0, 0, 0, 1, 0, 0, 0, 0}, all[3] = {1, 1, 1};
    const size_t square[2] = {3, 3}, line[2] = {3, 1};
    problem one = problem_of(2, square, inside, 4);
    check_dense(&one);
    problem_clear(&one);
    for (uint32_t root = 0; root < 3; ++root)
        for (int32_t dim = 1; dim <= 2; ++dim) {
            problem p = problem_of(dim, line, all, root);
            check_dense(&p);
            p.top[2] = p.top[1];
            p.share[2] = 0.25;
            check_dense(&p);
            problem_clear(&p);
        }
}
END_TEST

/* -------------------------------------------------------------------- trouble */

static icc_status solve_in(const icc_env *outer, icc_error *err, void *argument)
{
    problem *p = argument;
    const iccp_ties ties = {.top = p->top, .share = p->share};
    iccp_solution info = {0};
    iccp_env env;
    const icc_status status = iccp_env_read(&env, outer, err);
    if (status != ICC_OK)
        return status;
    for (size_t k = 0; k < p->unknowns.n; ++k)
        iccp_scaled_set(&p->f, k, 1, 0);
    return iccp_explain(err, iccp_tied_iterative(&p->unknowns, &ties, &p->f, &info, &env));
}

START_TEST(gives_up_cleanly)
{
    random_source r = {6};
    for (int percent = 0; percent <= 20; percent += 20) {
        problem p = drawn(mask_serpentine, 2, 40);
        tie(&p, &r, percent, 0.9);
        faulty_sweep(solve_in, &p);
        problem_clear(&p);
    }
}
END_TEST

/* Guesses may be bad. */
START_TEST(any_guess_will_do)
{
    random_source r = {7};
    for (int trial = 0; trial < 20; ++trial) {
        problem p = scattered(&r, 2);
        tie(&p, &r, trial % 2 ? 30 : 0, 0.9);
        for (size_t k = 0; k < p.unknowns.n; ++k)
            iccp_scaled_set(&p.f, k, random_between(&r, 0.1, 1), random_below(&r, 4000) - 3000);
        check_dense(&p);
        problem_clear(&p);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("multigrid");
    TCase *tests = tcase_create("multigrid");
    tcase_add_test(tests, kernels_agree_to_the_bit);
    tcase_add_test(tests, cycle_is_symmetric_positive_definite);
    tcase_add_test(tests, iterations_do_not_grow);
    tcase_add_test(tests, plain_agrees_with_elimination);
    tcase_add_test(tests, tied_agrees_with_elimination);
    tcase_add_test(tests, every_mask_is_solved);
    tcase_add_test(tests, decay_is_followed);
    tcase_add_test(tests, tied_decay_is_followed);
    tcase_add_test(tests, good_guess_saves_iterations);
    tcase_add_test(tests, smallest_problems);
    tcase_add_test(tests, gives_up_cleanly);
    tcase_add_test(tests, any_guess_will_do);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
