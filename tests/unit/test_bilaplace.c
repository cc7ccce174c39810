/* Bi-Laplace functions against dense references. */
#include "base/error.h"
#include "field/bilaplace.h"
#include "field/critical.h"
#include "field/energy.h"

#include "../faulty.h"
#include "../hard_masks.h"
#include "../random.h"

#include <check.h>
#include <math.h>
#include <string.h>

typedef struct problem {
    icc_tree *tree;
    iccp_rows rows;
    size_t n;
    iccp_scaled f;
} problem;

static iccp_env plain_env(void)
{
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, NULL, NULL), ICC_OK);
    return env;
}

static problem problem_on(int32_t dim, const size_t *sides, const uint8_t *inside, uint32_t root)
{
    const iccp_env env = plain_env();
    problem p;
    icc_grid *grid;
    ck_assert_int_eq(icc_grid_create_mask(&grid, dim, sides, inside, NULL, NULL), ICC_OK);
    if (root == UINT32_MAX)
        ck_assert_int_eq(icc_grid_maximum(grid, &root, NULL, NULL, NULL), ICC_OK);
    ck_assert_int_eq(icc_tree_create(&p.tree, grid, root, NULL, NULL, NULL), ICC_OK);
    icc_grid_free(grid);
    ck_assert_int_eq(iccp_rows_create(&p.rows, p.tree, &env), ICC_OK);
    p.n = p.rows.n;
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
    iccp_rows_free(&p->rows);
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
        unpack(grid, p->rows.vertex[k], place[k]);
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
    const iccp_env env = plain_env();
    for (int round = 0; round < 200; ++round) {
        problem p = random_problem(&r, 1 + round % 4);
        for (int k = 0; k < 2; ++k) {
            icc_field_info info = {.size = sizeof info};
            ck_assert_int_eq(iccp_bilaplace(&p.rows, FUNCTIONS[k], ICC_SOLVER_DIRECT, &p.f, &info, &env),
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

START_TEST(nothing_underflows)
{
    const iccp_env env = plain_env();
    problem p = problem_of(mask_serpentine, 2, 500);
    icc_field_info info = {.size = sizeof info};
    ck_assert_int_eq(iccp_bilaplace(&p.rows, ICC_FUNCTION_BILAPLACE, ICC_SOLVER_DIRECT, &p.f, &info, &env),
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

typedef struct sweep_case {
    problem p;
    int32_t function;
} sweep_case;

static icc_status solve_anew(const icc_env *outer, icc_error *err, void *argument)
{
    sweep_case *c = argument;
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, outer, err), ICC_OK);
    icc_field_info info = {.size = sizeof info};
    const icc_status status =
        iccp_bilaplace(&c->p.rows, c->function, ICC_SOLVER_DIRECT, &c->p.f, &info, &env);
    return iccp_explain(err, status);
}

START_TEST(failures_leave_nothing_behind)
{
    for (int k = 0; k < 2; ++k) {
        sweep_case c = {problem_of(mask_c, 2, 20), FUNCTIONS[k]};
        faulty_sweep(solve_anew, &c);
        problem_clear(&c.p);
    }
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("bi-Laplace");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, small_minima_are_those_of_a_dense_solver);
    tcase_add_test(tests, nothing_underflows);
    tcase_add_test(tests, failures_leave_nothing_behind);
    suite_add_tcase(suite, tests);
    SRunner *runner = srunner_create(suite);
    srunner_run_all(runner, CK_NORMAL);
    const int n_failed = srunner_ntests_failed(runner);
    srunner_free(runner);
    return n_failed == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
