/* Equations with fixed values and a right-hand side, against dense elimination. */
#include "../faulty.h"
#include "../random.h"
#include "../suite.h"

#include <icc/stages.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_DIM = 4, MOST_VERTICES = 256 };

typedef struct problem {
    int32_t dim;
    size_t shape[MOST_DIM], n;
    uint8_t inside[MOST_VERTICES];
    double fixed[MOST_VERTICES], right_side[MOST_VERTICES];
    icc_tree *tree;
} problem;

static void problem_init(problem *p, random_source *r, int32_t dim)
{
    static const int SIDES[MOST_DIM + 1] = {0, 40, 12, 6, 4};
    icc_grid *grid;
    p->dim = dim;
    p->n = 1;
    for (int32_t k = 0; k < dim; ++k)
        p->n *= p->shape[k] = (size_t)(2 + random_below(r, SIDES[dim] - 1));
    const int density = 5 + random_below(r, 6);
    for (size_t v = 0; v < p->n; ++v) {
        p->inside[v] = random_below(r, 10) < density;
        p->fixed[v] = random_below(r, 4) == 0 ? random_between(r, -2, 2) : NAN;
        p->right_side[v] = isnan(p->fixed[v]) ? random_between(r, -1, 1) : NAN;
    }
    const uint32_t root = (uint32_t)random_below(r, (int)p->n);
    p->inside[root] = 1;
    ck_assert_int_eq(icc_grid_create_mask(&grid, dim, p->shape, p->inside, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&p->tree, grid, root, NULL, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
}

/* Returns the neighbour in direction d, or UINT32_MAX. */
static uint32_t neighbour(const problem *p, uint32_t v, int32_t d)
{
    uint32_t stride = 1;
    for (int32_t k = 0; k < d / 2; ++k)
        stride *= (uint32_t)p->shape[k];
    const uint32_t at = v / stride % (uint32_t)p->shape[d / 2];
    if (d % 2 == 0)
        return at == 0 ? UINT32_MAX : v - stride;
    return at + 1 == p->shape[d / 2] ? UINT32_MAX : v + stride;
}

static int is_unknown(const problem *p, uint32_t v)
{
    return p->inside[v] && icc_tree_generations(p->tree)[v] >= 0;
}

/* The Laplacian of f at an inside vertex. Beyond the grid f is 0. */
static double laplacian(const problem *p, const double *f, uint32_t v)
{
    double sum = 0;
    for (int32_t d = 0; d < 2 * p->dim; ++d) {
        const uint32_t u = neighbour(p, v, d);
        sum += f[v] - (u == UINT32_MAX ? 0 : f[u]);
    }
    return sum;
}

/* The left side of the equation, at all vertices. */
static void apply(const problem *p, int32_t function, const double *f, double *out)
{
    double first[MOST_VERTICES] = {0};
    for (uint32_t v = 0; v < p->n; ++v)
        first[v] = is_unknown(p, v) ? laplacian(p, f, v) : 0;
    for (uint32_t v = 0; v < p->n; ++v) {
        if (function == ICC_FUNCTION_LAPLACE || !is_unknown(p, v))
            out[v] = first[v];
        else
            out[v] = laplacian(p, first, v);
    }
}

/* Solves by Gaussian elimination with pivots. Row by row, m has the matrix and the right side. */
static void eliminate(size_t n, double *m)
{
    const size_t w = n + 1;
    for (size_t c = 0; c < n; ++c) {
        size_t pivot = c;
        for (size_t i = c + 1; i < n; ++i)
            pivot = fabs(m[i * w + c]) > fabs(m[pivot * w + c]) ? i : pivot;
        for (size_t k = 0; k < w; ++k) {
            const double swap = m[c * w + k];
            m[c * w + k] = m[pivot * w + k];
            m[pivot * w + k] = swap;
        }
        for (size_t i = 0; i < n; ++i) {
            const double factor = i == c ? 0 : m[i * w + c] / m[c * w + c];
            for (size_t k = c; k < w; ++k)
                m[i * w + k] -= factor * m[c * w + k];
        }
    }
    for (size_t i = 0; i < n; ++i)
        m[i * w + n] /= m[i * w + i];
}

/* Fills in f at the free vertices. The columns of the matrix are what unit values there give.
 * Returns their number. */
static size_t solve_densely(const problem *p, int32_t function, double *f)
{
    uint32_t vertex[MOST_VERTICES];
    size_t n = 0;
    double without[MOST_VERTICES], with[MOST_VERTICES];
    for (uint32_t v = 0; v < p->n; ++v) {
        const int is_free = is_unknown(p, v) && isnan(p->fixed[v]);
        f[v] = isnan(p->fixed[v]) ? 0 : p->fixed[v];
        if (is_free)
            vertex[n++] = v;
    }
    double *m = malloc((n + 1) * (n + 1) * sizeof *m);
    apply(p, function, f, without);
    for (size_t c = 0; c < n; ++c) {
        f[vertex[c]] = 1;
        apply(p, function, f, with);
        f[vertex[c]] = 0;
        for (size_t i = 0; i < n; ++i)
            m[i * (n + 1) + c] = with[vertex[i]] - without[vertex[i]];
    }
    for (size_t i = 0; i < n; ++i)
        m[i * (n + 1) + n] = p->right_side[vertex[i]] - without[vertex[i]];
    eliminate(n, m);
    for (size_t i = 0; i < n; ++i)
        f[vertex[i]] = m[i * (n + 1) + n];
    free(m);
    return n;
}

START_TEST(solutions_are_those_of_elimination)
{
    random_source r = {1};
    size_t n_all = 0;
    for (int round = 0; round < 160; ++round) {
        problem p;
        double f[MOST_VERTICES];
        const int32_t function = round % 2 ? ICC_FUNCTION_LAPLACE : ICC_FUNCTION_BILAPLACE;
        const icc_function_options options = {.size = sizeof options, .function = function};
        icc_function *solution;
        icc_function_info info = {.size = sizeof info};
        problem_init(&p, &r, 1 + round / 2 % MOST_DIM);
        const size_t n = solve_densely(&p, function, f);
        ck_assert_int_eq(icc_function_create_solve(&solution, p.tree, &options, p.fixed,
                                                   p.right_side, NULL, NULL),
                         ICC_OK);
        ck_assert_int_eq(icc_function_get_info(solution, &info), ICC_OK);
        ck_assert_int_eq(info.function, function);
        ck_assert_int_eq(info.solver, ICC_SOLVER_DIRECT);
        ck_assert_uint_eq(info.n_unknowns, n);
        double size = 1;
        for (uint32_t v = 0; v < p.n; ++v)
            size = is_unknown(&p, v) ? fmax(size, fabs(f[v])) : size;
        ck_assert_double_lt(info.residual, 1e-12 * size);
        const double *values = icc_function_values(solution);
        for (uint32_t v = 0; v < p.n; ++v) {
            int beside = is_unknown(&p, v);
            for (int32_t d = 0; d < 2 * p.dim; ++d) {
                const uint32_t u = neighbour(&p, v, d);
                beside = beside || (u != UINT32_MAX && is_unknown(&p, u));
            }
            if (beside)
                ck_assert_double_eq_tol(values[v], f[v], 1e-10 * size);
        }
        n_all += n;
        icc_function_free(solution);
        icc_tree_free(p.tree);
    }
    ck_assert_uint_gt(n_all, 2000);
}
END_TEST

/* With the root fixed to 1, the equation is that of icc_function_create(). */
START_TEST(a_fixed_root_gives_the_usual_function)
{
    random_source r = {2};
    for (int round = 0; round < 40; ++round) {
        problem p;
        const icc_function_options options = {.size = sizeof options,
                                              .function = round % 2 ? ICC_FUNCTION_LAPLACE
                                                                    : ICC_FUNCTION_BILAPLACE,
                                              .constraints = ICC_CONSTRAINTS_NONE};
        icc_function *solution, *usual;
        double fixed[MOST_VERTICES];
        problem_init(&p, &r, 1 + round / 2 % MOST_DIM);
        for (size_t v = 0; v < p.n; ++v)
            fixed[v] = v == icc_tree_root(p.tree) ? 1 : NAN;
        ck_assert_int_eq(
            icc_function_create_solve(&solution, p.tree, &options, fixed, NULL, NULL, NULL),
            ICC_OK);
        const icc_status status = icc_function_create(&usual, p.tree, &options, NULL, NULL);
        ck_assert(status == ICC_OK || status == ICC_ERR_RESOLUTION); /* only the root is inside */
        for (uint32_t v = 0; v < p.n && status == ICC_OK; ++v)
            if (is_unknown(&p, v))
                ck_assert_double_eq_tol(icc_function_values(solution)[v],
                                        icc_function_values(usual)[v], 1e-12);
        icc_function_free(usual);
        icc_function_free(solution);
        icc_tree_free(p.tree);
    }
}
END_TEST

static icc_status solve(const icc_env *env, icc_error *err, void *argument)
{
    const problem *p = argument;
    const icc_function_options options = {.size = sizeof options,
                                          .function = ICC_FUNCTION_BILAPLACE};
    icc_function *function;
    const icc_status status =
        icc_function_create_solve(&function, p->tree, &options, p->fixed, p->right_side, env, err);
    ck_assert_int_eq(function != NULL, status == ICC_OK);
    icc_function_free(function);
    return status;
}

static icc_status status_of(const problem *p, int32_t function, int32_t constraints, int32_t solver)
{
    const icc_function_options options = {
        .size = sizeof options, .function = function, .constraints = constraints, .solver = solver};
    icc_function *made;
    const icc_status status =
        icc_function_create_solve(&made, p->tree, &options, p->fixed, p->right_side, NULL, NULL);
    icc_function_free(made);
    return status;
}

START_TEST(what_cannot_be_solved_is_refused)
{
    random_source r = {3};
    problem p;
    icc_function *function;
    icc_error err = {.size = sizeof err};
    problem_init(&p, &r, 2);
    faulty_sweep(solve, &p);
    ck_assert_int_eq(status_of(&p, 0, 0, 0), ICC_OK);
    ck_assert_int_eq(status_of(&p, 0, ICC_CONSTRAINTS_NONE, ICC_SOLVER_DIRECT), ICC_OK);
    for (int32_t kind = ICC_FUNCTION_DECAY; kind <= ICC_FUNCTION_HARMONIC; ++kind)
        ck_assert_int_eq(status_of(&p, kind, 0, 0),
                         kind == ICC_FUNCTION_LAPLACE || kind == ICC_FUNCTION_BILAPLACE
                             ? ICC_OK
                             : ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(status_of(&p, 0, ICC_CONSTRAINTS_ALL, 0), ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(status_of(&p, 0, ICC_CONSTRAINTS_NEEDED, 0), ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(status_of(&p, 0, 0, ICC_SOLVER_ITERATIVE), ICC_ERR_UNSUPPORTED);
    ck_assert_int_eq(status_of(&p, 99, 0, 0), ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_create_solve(NULL, p.tree, NULL, NULL, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    ck_assert_int_eq(icc_function_create_solve(&function, NULL, NULL, NULL, NULL, NULL, &err),
                     ICC_ERR_ARGUMENT);
    const uint32_t root = icc_tree_root(p.tree);
    for (int k = 0; k < 2; ++k) {
        p.fixed[root] = k == 0 ? INFINITY : -0x1p901;
        ck_assert_int_eq(
            icc_function_create_solve(&function, p.tree, NULL, p.fixed, NULL, NULL, &err),
            ICC_ERR_ARGUMENT);
        ck_assert(err.item == ICC_ITEM_GRID_VERTEX && err.index == root);
    }
    p.right_side[root] = NAN;
    ck_assert_int_eq(
        icc_function_create_solve(&function, p.tree, NULL, NULL, p.right_side, NULL, &err),
        ICC_ERR_ARGUMENT);
    icc_tree_free(p.tree);
}
END_TEST

/* All vertices fixed, none fixed, and values at the ends of doubles. */
START_TEST(extreme_problems)
{
    random_source r = {4};
    problem p;
    icc_function *function;
    icc_error err = {.size = sizeof err};
    problem_init(&p, &r, 3);
    for (size_t v = 0; v < p.n; ++v)
        p.fixed[v] = (double)v;
    ck_assert_int_eq(icc_function_create_solve(&function, p.tree, NULL, p.fixed, NULL, NULL, NULL),
                     ICC_OK);
    for (uint32_t v = 0; v < p.n; ++v)
        ck_assert(!is_unknown(&p, v) || icc_function_values(function)[v] == v);
    icc_function_free(function);
    ck_assert_int_eq(icc_function_create_solve(&function, p.tree, NULL, NULL, NULL, NULL, NULL),
                     ICC_OK);
    for (uint32_t v = 0; v < p.n; ++v)
        ck_assert(!is_unknown(&p, v) || icc_function_values(function)[v] == 0);
    icc_function_free(function);
    for (size_t v = 0; v < p.n; ++v) {
        p.fixed[v] = NAN;
        p.right_side[v] = 1.7e308;
    }
    for (int k = 0; k < 2; ++k) {
        ck_assert_int_eq(
            icc_function_create_solve(&function, p.tree, NULL, p.fixed, p.right_side, NULL, &err),
            ICC_ERR_SOLVER);
        ck_assert_ptr_null(function);
        for (size_t v = 0; v < p.n; ++v)
            p.right_side[v] = 0x1p901;
    }
    icc_tree_free(p.tree);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("solve");
    TCase *tests = tcase_create("solve");
    tcase_set_timeout(tests, 0);
    tcase_add_test(tests, solutions_are_those_of_elimination);
    tcase_add_test(tests, a_fixed_root_gives_the_usual_function);
    tcase_add_test(tests, what_cannot_be_solved_is_refused);
    tcase_add_test(tests, extreme_problems);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
