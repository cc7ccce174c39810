/* The two ways to solve sparse positive definite systems, against each other and, where the
 * libraries are installed, against CHOLMOD and CXSparse. */
#include "math/pcg.h"
#include "math/scaled.h"
#include "math/spd.h"
#include "mesh/laplacian.h"

#include "../../default_env.h"
#include "../../faulty.h"
#include "../../hard_shapes.h"
#include "../../share.h"
#include "../../suite.h"

#include <check.h>
#include <stdlib.h>

#ifdef TEST_WITH_SUITESPARSE
#include <cholmod.h>
#include <cs.h>
#endif

typedef struct equations {
    iccp_symmetric m;
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
} equations;

/* Edges (a, b, weight); the diagonal is the sum of a row's weights plus `extra`. */
typedef struct edge {
    uint32_t a, b;
    double weight;
} edge;

static equations from_edges(size_t n, size_t n_edges, const edge *edges, const double *extra)
{
    equations s = {.first = calloc(n + 2, sizeof *s.first),
                   .column = calloc(2 * n_edges + 1, sizeof *s.column),
                   .value = calloc(2 * n_edges + 1, sizeof *s.value),
                   .diagonal = calloc(n + 1, sizeof *s.diagonal)};
    for (size_t e = 0; e < n_edges; ++e) {
        ++s.first[edges[e].a];
        ++s.first[edges[e].b];
    }
    for (size_t i = 1; i <= n; ++i)
        s.first[i] += s.first[i - 1];
    for (size_t i = 0; i < n; ++i)
        s.diagonal[i] = extra[i];
    for (size_t e = 0; e < n_edges; ++e)
        for (int k = 0; k < 2; ++k) {
            const uint32_t row = k ? edges[e].b : edges[e].a;
            const size_t p = --s.first[row];
            s.column[p] = k ? edges[e].a : edges[e].b;
            s.value[p] = -edges[e].weight;
            s.diagonal[row] += edges[e].weight;
        }
    s.m = (iccp_symmetric){n, s.first, s.column, s.value, s.diagonal};
    return s;
}

static void system_clear(equations *s)
{
    free(s->first);
    free(s->column);
    free(s->value);
    free(s->diagonal);
}

/* Five-point Laplacian of a square, 0 round it. */
static equations grid_system(uint32_t size)
{
    const size_t n = (size_t)size * size;
    edge *edges = malloc((2 * n + 1) * sizeof *edges);
    double *extra = calloc(n + 1, sizeof *extra);
    size_t n_edges = 0;
    for (uint32_t j = 0; j < size; ++j)
        for (uint32_t i = 0; i < size; ++i) {
            const uint32_t v = i + size * j;
            if (i + 1 < size)
                edges[n_edges++] = (edge){v, v + 1, 1};
            if (j + 1 < size)
                edges[n_edges++] = (edge){v, v + size, 1};
            extra[v] = (i == 0) + (j == 0) + (i + 1 == size) + (j + 1 == size);
        }
    const equations s = from_edges(n, n_edges, edges, extra);
    free(edges);
    free(extra);
    return s;
}

/* A random connected M-matrix; weights over `decades` powers of ten. */
static bool is_there(size_t n, const edge *edges, uint32_t a, uint32_t b)
{
    for (size_t e = 0; e < n; ++e)
        if (edges[e].a == a && edges[e].b == b)
            return true;
    return false;
}

static equations random_system(size_t n, double decades, random_source *r)
{
    size_t n_edges = 0;
    edge *edges = malloc(3 * n * sizeof *edges);
    double *extra = calloc(n, sizeof *extra);
    for (size_t e = 0; e < 3 * n - 1; ++e) {
        const uint32_t b = (uint32_t)(e + 1 < n ? e + 1 : 1 + (size_t)random_below(r, (int)n - 1));
        const uint32_t a = (uint32_t)random_below(r, (int)b);
        if (!is_there(n_edges, edges, a, b))
            edges[n_edges++] = (edge){a, b, pow(10, random_between(r, -decades / 2, decades / 2))};
    }
    extra[random_below(r, (int)n)] = 1;
    const equations s = from_edges(n, n_edges, edges, extra);
    free(edges);
    free(extra);
    return s;
}

static double multiply_row(const iccp_symmetric *m, size_t i, const double *x, size_t n_rhs,
                           size_t r, double *size)
{
    double sum = m->diagonal[i] * x[i * n_rhs + r];
    *size += fabs(sum);
    for (size_t p = m->first[i]; p < m->first[i + 1]; ++p) {
        const double term = m->value[p] * x[m->column[p] * n_rhs + r];
        sum += term;
        *size += fabs(term);
    }
    return sum;
}

/* |A x - b| in units of |A| |x| + |b|, row by row (the backward error), the worst of them. */
static double backward_error(const iccp_symmetric *m, const double *x, const double *b,
                             size_t n_rhs)
{
    double worst = 0;
    for (size_t r = 0; r < n_rhs; ++r)
        for (size_t i = 0; i < m->n; ++i) {
            double size = fabs(b[i * n_rhs + r]);
            const double sum = multiply_row(m, i, x, n_rhs, r, &size);
            if (size > 0)
                worst = fmax(worst, fabs(sum - b[i * n_rhs + r]) / size);
        }
    return worst;
}

/* |A x - b| / |b| of the worst right side. */
static double residual(const iccp_symmetric *m, const double *x, const double *b, size_t n_rhs)
{
    double worst = 0;
    for (size_t r = 0; r < n_rhs; ++r) {
        double error = 0, right = 0, size = 0;
        for (size_t i = 0; i < m->n; ++i) {
            error = hypot(error, multiply_row(m, i, x, n_rhs, r, &size) - b[i * n_rhs + r]);
            right = hypot(right, b[i * n_rhs + r]);
        }
        if (right > 0)
            worst = fmax(worst, error / right);
    }
    return worst;
}

static double *random_sides(size_t n, random_source *r)
{
    double *b = malloc((n + 1) * sizeof *b);
    for (size_t i = 0; i < n; ++i)
        b[i] = random_between(r, -1, 1);
    return b;
}

/* By conjugate gradients, one side after the other. */
static icc_status iterate(const iccp_symmetric *m, size_t n_rhs, double *b, const iccp_env *env)
{
    double *side = malloc((m->n + 1) * sizeof *side);
    double *work = malloc((m->n + 1) * ICCP_PCG_WORK * sizeof *work);
    icc_status status = ICC_OK;
    for (size_t r = 0; r < n_rhs && status == ICC_OK; ++r) {
        for (size_t i = 0; i < m->n; ++i)
            side[i] = b[i * n_rhs + r];
        status = iccp_pcg_solve(m, NULL, NULL, side, work, env);
        for (size_t i = 0; i < m->n; ++i)
            b[i * n_rhs + r] = side[i];
    }
    free(side);
    free(work);
    return status;
}

static icc_status solve_with(const iccp_symmetric *m, bool iterative, size_t n_rhs, double *b,
                             const iccp_env *env)
{
    iccp_ldlt factor;
    if (iterative)
        return iterate(m, n_rhs, b, env);
    icc_status status = iccp_spd_create(&factor, m, env);
    if (status != ICC_OK)
        return status;
    status = iccp_spd_solve(&factor, n_rhs, b, env);
    iccp_ldlt_free(&factor);
    return status;
}

static void solve(const iccp_symmetric *m, bool iterative, const double *b, size_t n_rhs, double *x)
{
    const iccp_env env = default_env();
    memcpy(x, b, m->n * n_rhs * sizeof *x);
    ck_assert_int_eq(solve_with(m, iterative, n_rhs, x, &env), ICC_OK);
}

#ifdef TEST_WITH_SUITESPARSE

/* Column j of the upper triangle (CHOLMOD) or of the whole matrix (CXSparse). */
static void fill_columns(const iccp_symmetric *m, bool upper, int *start, int *row, double *value)
{
    int k = 0;
    for (size_t j = 0; j < m->n; ++j) {
        start[j] = k;
        row[k] = (int)j;
        value[k++] = m->diagonal[j];
        for (size_t p = m->first[j]; p < m->first[j + 1]; ++p)
            if (!upper || m->column[p] < j) {
                row[k] = (int)m->column[p];
                value[k++] = m->value[p];
            }
    }
    start[m->n] = k;
}

static void solve_by_cholmod(const iccp_symmetric *m, const double *b, double *x)
{
    cholmod_common common;
    cholmod_start(&common);
    cholmod_sparse *a =
        cholmod_allocate_sparse(m->n, m->n, m->n + m->first[m->n], 0, 1, 1, CHOLMOD_REAL, &common);
    fill_columns(m, true, a->p, a->i, a->x);
    cholmod_dense *right = cholmod_allocate_dense(m->n, 1, m->n, CHOLMOD_REAL, &common);
    memcpy(right->x, b, m->n * sizeof *b);
    cholmod_factor *factor = cholmod_analyze(a, &common);
    cholmod_factorize(a, factor, &common);
    cholmod_dense *solution = cholmod_solve(CHOLMOD_A, factor, right, &common);
    memcpy(x, solution->x, m->n * sizeof *x);
    cholmod_free_dense(&solution, &common);
    cholmod_free_dense(&right, &common);
    cholmod_free_factor(&factor, &common);
    cholmod_free_sparse(&a, &common);
    cholmod_finish(&common);
}

static void solve_by_cxsparse(const iccp_symmetric *m, const double *b, double *x)
{
    cs_di *a = cs_di_spalloc((int)m->n, (int)m->n, (int)(m->n + m->first[m->n]), 1, 0);
    fill_columns(m, false, a->p, a->i, a->x);
    memcpy(x, b, m->n * sizeof *x);
    ck_assert_int_eq(cs_di_cholsol(1, a, x), 1);
    cs_di_spfree(a);
}

#endif

/* The same solution from everybody, relative to the largest entry. */
static void check_oracles(const iccp_symmetric *m, const double *b, const double *x,
                          double tolerance)
{
#ifdef TEST_WITH_SUITESPARSE
    double *y = malloc((m->n + 1) * sizeof *y), largest = 0;
    for (size_t i = 0; i < m->n; ++i)
        largest = fmax(largest, fabs(x[i]));
    for (int k = 0; k < 2; ++k) {
        (k ? solve_by_cholmod : solve_by_cxsparse)(m, b, y);
        for (size_t i = 0; i < m->n; ++i)
            ck_assert_double_le(fabs(x[i] - y[i]), tolerance * largest);
    }
    free(y);
#else
    (void)m;
    (void)b;
    (void)x;
    (void)tolerance;
#endif
}

/* Direct, iterative and the oracles agree to `tolerance`. */
static void check_system(const iccp_symmetric *m, double tolerance, random_source *r)
{
    enum { SIDES = 3 };
    const size_t n = m->n;
    double *b = random_sides(SIDES * n, r), *x = malloc((SIDES * n + 1) * sizeof *x);
    double *y = malloc((SIDES * n + 1) * sizeof *y), largest = 0;
    solve(m, false, b, SIDES, x);
    ck_assert_double_le(backward_error(m, x, b, SIDES), 1e-12);
    solve(m, true, b, SIDES, y);
    ck_assert_double_le(residual(m, y, b, SIDES), 1e-8);
    for (size_t i = 0; i < SIDES * n; ++i)
        largest = fmax(largest, fabs(x[i]));
    for (size_t i = 0; i < SIDES * n; ++i)
        ck_assert_double_le(fabs(x[i] - y[i]), tolerance * largest);
    /* One side alone gives the same as among others, bit by bit. */
    for (size_t side = 0; side < SIDES; ++side)
        for (int iterative = 0; iterative < 2; ++iterative) {
            double *one = malloc((n + 1) * sizeof *one), *alone = malloc((n + 1) * sizeof *alone);
            for (size_t i = 0; i < n; ++i)
                one[i] = b[i * SIDES + side];
            solve(m, iterative, one, 1, alone);
            for (size_t i = 0; i < n; ++i)
                ck_assert(!(fabs(alone[i] - (iterative ? y : x)[i * SIDES + side]) > 0));
            if (side == 0 && !iterative)
                check_oracles(m, one, alone, tolerance);
            free(one);
            free(alone);
        }
    free(b);
    free(x);
    free(y);
}

START_TEST(grids_are_solved)
{
    static const uint32_t SIZES[] = {1, 2, 3, 10, 60, 150};
    random_source r = {1};
    for (size_t k = 0; k < sizeof SIZES / sizeof *SIZES; ++k) {
        equations s = grid_system(SIZES[k]);
        check_system(&s.m, 1e-9, &r);
        system_clear(&s);
    }
}
END_TEST

START_TEST(random_matrices_are_solved)
{
    random_source r = {2};
    for (int k = 0; k < 60; ++k) {
        equations s = random_system(2 + (size_t)random_below(&r, 300), k % 4, &r);
        check_system(&s.m, 1e-6, &r);
        system_clear(&s);
    }
}
END_TEST

/* Weights over twelve powers of ten: the factorisation is still backward stable; the iteration may
 * give up, but does not pretend. */
START_TEST(extreme_weights_are_solved_or_refused)
{
    random_source r = {3};
    int n_solved = 0;
    for (int k = 0; k < 40; ++k) {
        equations s = random_system(50 + (size_t)random_below(&r, 200), 12, &r);
        const iccp_env env = default_env();
        double *b = random_sides(s.m.n, &r), *x = malloc(s.m.n * sizeof *x);
        solve(&s.m, false, b, 1, x);
        ck_assert_double_le(backward_error(&s.m, x, b, 1), 1e-12);
        memcpy(x, b, s.m.n * sizeof *x);
        const icc_status status = solve_with(&s.m, true, 1, x, &env);
        ck_assert(status == ICC_OK || status == ICC_ERR_SOLVER);
        n_solved += status == ICC_OK;
        free(b);
        free(x);
        system_clear(&s);
    }
    ck_assert_int_gt(n_solved, 0);
}
END_TEST

/* The systems that the library makes, of thin and wild shapes. */
START_TEST(mesh_laplacians_are_solved)
{
    const shape s = shape_hard(_i);
    const iccp_env env = default_env();
    random_source r = {4};
    uint32_t pieces[SHAPE_MAX];
    icc_domain *domain;
    iccp_planar mesh;
    iccp_laplacian l;
    ck_assert_int_eq(icc_domain_create(&domain, 2, s.n, s.xy, 0, NULL, NULL, NULL), ICC_OK);
    iccp_planar_pieces(pieces, domain, NULL, 40);
    ck_assert_int_eq(iccp_planar_create(&mesh, domain, pieces, 40, &env, NULL), ICC_OK);
    for (int k = 0; k < 2; ++k) {
        const uint32_t left_out = k ? (uint32_t)(mesh.n_vertices - 1) : ICCP_NO_NEIGHBOUR;
        ck_assert_int_eq(iccp_laplacian_create(&l, &mesh, left_out, &env), ICC_OK);
        for (size_t i = 0; i < l.matrix.n; ++i) {
            double sum = l.diagonal[i];
            for (size_t p = l.first[i]; p < l.first[i + 1]; ++p) {
                ck_assert(l.value[p] < 0 && l.column[p] != i);
                sum += l.value[p];
            }
            for (size_t p = l.boundary_first[i]; p < l.boundary_first[i + 1]; ++p) {
                ck_assert(l.boundary_weight[p] > 0 && l.boundary_vertex[p] < mesh.n_boundary);
                sum -= l.boundary_weight[p];
            }
            const bool is_own = k && i == l.matrix.n - 1;
            ck_assert_double_le(fabs(sum - is_own), 1e-13 * l.diagonal[i]);
        }
        check_system(&l.matrix, 1e-7, &r);
        iccp_laplacian_free(&l);
    }
    iccp_planar_free(&mesh);
    icc_domain_free(domain);
}
END_TEST

START_TEST(nothing_and_one_row_are_solved)
{
    const size_t first[2] = {0, 0};
    const double diagonal = 4;
    double x[1] = {2};
    const iccp_symmetric none = {0, first, NULL, NULL, NULL},
                         one = {1, first, NULL, NULL, &diagonal};
    for (int iterative = 0; iterative < 2; ++iterative) {
        const double b[1] = {2};
        solve(&none, iterative, b, 1, x);
        solve(&one, iterative, b, 1, x);
        ck_assert_double_eq(x[0], 0.5);
        solve(&one, iterative, (double[]){0}, 1, x);
        ck_assert_double_eq(x[0], 0);
    }
}
END_TEST

static icc_status try_to_solve(const iccp_symmetric *m, bool iterative, const double *b, double *x)
{
    const iccp_env env = default_env();
    memcpy(x, b, m->n * sizeof *x);
    return solve_with(m, iterative, 1, x, &env);
}

START_TEST(other_matrices_are_refused)
{
    random_source r = {5};
    for (int k = 0; k < 6; ++k) {
        equations s = grid_system(12);
        double *b = random_sides(s.m.n, &r), *x = malloc(s.m.n * sizeof *x);
        double *d = s.diagonal;
        switch (k) {
        case 0:
            d[70] = -1;
            break;
        case 1:
            d[70] = 0;
            break;
        case 2: /* indefinite, yet with a positive diagonal */
            for (size_t i = 0; i < s.m.n; ++i)
                d[i] = 3;
            break;
        case 3:
            d[70] = NAN;
            break;
        case 4:
            d[70] = HUGE_VAL;
            s.value[s.first[70]] = -HUGE_VAL;
            break;
        default: /* negative definite */
            for (size_t i = 0; i < s.m.n; ++i)
                d[i] = -d[i];
        }
        for (int iterative = 0; iterative < 2; ++iterative)
            if (try_to_solve(&s.m, iterative, b, x) != ICC_ERR_SOLVER)
                ck_abort_msg("matrix %d is solved, %d", k, iterative);
        free(b);
        free(x);
        system_clear(&s);
    }
}
END_TEST

static icc_status sweep_solve(const iccp_symmetric *m, bool iterative, faulty *f)
{
    const icc_env outer = faulty_env(f);
    iccp_env env;
    ck_assert_int_eq(iccp_env_read(&env, &outer, NULL), ICC_OK);
    double *b = calloc(m->n, sizeof *b);
    b[0] = 1;
    const icc_status status = solve_with(m, iterative, 1, b, &env);
    free(b);
    ck_assert_uint_eq(f->n_live, 0);
    return status;
}

START_TEST(failures_leave_nothing_behind)
{
    equations s = grid_system(60);
    for (int iterative = 0; iterative < 2; ++iterative)
        for (int cancels = iterative; cancels < 2; ++cancels) { /* iterations allocate nothing */
            icc_status status = -1;
            size_t k = 0;
            while (status != ICC_OK) {
                k = share_next(k);
                faulty f = {.fail_at = cancels ? 0 : k, .cancel_at = cancels ? k : 0};
                status = sweep_solve(&s.m, iterative, &f);
                ck_assert(status == ICC_OK ||
                          status == (cancels ? ICC_ERR_CANCELLED : ICC_ERR_MEMORY));
            }
            ck_assert_uint_gt(k, 1);
        }
    system_clear(&s);
}
END_TEST

static iccp_scaled scaled_vector(size_t n)
{
    return (iccp_scaled){calloc(n + 1, sizeof(double)), calloc(n + 1, sizeof(int32_t))};
}

static void scaled_clear(iccp_scaled *v)
{
    free(v->fraction);
    free(v->exponent);
}

static iccp_ldlt factorised(const iccp_symmetric *m)
{
    const iccp_env env = default_env();
    iccp_ldlt factor;
    ck_assert_int_eq(iccp_ldlt_analyse(&factor, m, 1, &env), ICC_OK);
    ck_assert_int_eq(iccp_ldlt_factorise(&factor, m, &env), ICC_OK);
    return factor;
}

/* b * 2^exponent in, the solution out. */
static iccp_scaled solve_scaled(const iccp_ldlt *factor, const double *b, int32_t exponent)
{
    const iccp_env env = default_env();
    iccp_scaled x = scaled_vector(factor->n), work = scaled_vector(factor->n);
    for (size_t i = 0; i < factor->n; ++i)
        iccp_scaled_set(&x, i, b[i], exponent);
    ck_assert_int_eq(iccp_ldlt_solve_scaled(factor, &x, &work, &env), ICC_OK);
    for (size_t i = 0; i < factor->n; ++i)
        if (x.exponent[i] == ICCP_ZERO_EXPONENT)
            ck_assert(!(fabs(x.fraction[i]) > 0));
        else
            ck_assert(fabs(x.fraction[i]) >= 0.5 && fabs(x.fraction[i]) < 1);
    scaled_clear(&work);
    return x;
}

/* In the range of double the scaled solve gives what the plain one gives, and it is homogeneous
 * whatever the size of the right side. */
START_TEST(scaled_solves_agree_with_plain_ones)
{
    static const int32_t SHIFTS[] = {0, 1, 255, 256, 511, -257, 5000, -77777, 1000003, -9999999};
    random_source r = {6};
    for (size_t k = 0; k < 30; ++k) {
        equations s =
            k < 3 ? grid_system(30) : random_system(2 + (size_t)random_below(&r, 300), 4, &r);
        iccp_ldlt factor = factorised(&s.m);
        double *b = random_sides(s.m.n, &r), *x = malloc(2 * s.m.n * sizeof *x);
        for (size_t i = 0; i < s.m.n; ++i)
            b[i] = k % 2 ? fabs(b[i]) * (random_below(&r, 3) == 0) : b[i];
        memcpy(x, b, s.m.n * sizeof *x);
        iccp_ldlt_solve(&factor, 1, x, x + s.m.n);
        double largest = 0;
        for (size_t i = 0; i < s.m.n; ++i)
            largest = fmax(largest, fabs(x[i]));
        const int32_t shift = SHIFTS[k % (sizeof SHIFTS / sizeof *SHIFTS)];
        iccp_scaled y = solve_scaled(&factor, b, shift);
        for (size_t i = 0; i < s.m.n; ++i)
            ck_assert_double_le(fabs(iccp_scaled_get(&y, i, shift) - x[i]),
                                1e-12 * (k % 2 ? fabs(x[i]) : largest));
        scaled_clear(&y);
        iccp_ldlt_free(&factor);
        free(b);
        free(x);
        system_clear(&s);
    }
}
END_TEST

/* -f(k - 1) + 4 f(k) - f(k + 1) = [k = 0], f(n) = 0: f(k) = g^(k + 1) (1 - g^2(n - k)) / (1 - g^2(n
 * + 1)) with g = 2 - sqrt 3, down to 2^-38000.. */
START_TEST(long_chains_do_not_underflow)
{
    enum { N = 20000 };
    edge *edges = malloc(N * sizeof *edges);
    double *extra = calloc(N, sizeof *extra), *b = calloc(N, sizeof *b),
           *x = malloc(2 * N * sizeof *x);
    for (uint32_t k = 0; k < N; ++k) {
        edges[k] = (edge){k, k + 1, 1};
        extra[k] = k == 0 || k == N - 1 ? 3 : 2;
    }
    equations s = from_edges(N, N - 1, edges, extra);
    iccp_ldlt factor = factorised(&s.m);
    memcpy(x, b, N * sizeof *x);
    x[0] = b[0] = 1;
    iccp_ldlt_solve(&factor, 1, x, x + N);
    ck_assert(!(x[N - 1] > 0));
    iccp_scaled y = solve_scaled(&factor, b, 0);
    const long double g = 2 - sqrtl(3), unit = log2l(g);
    for (size_t k = 0; k < N; ++k) {
        const long double exact = (k + 1) * unit + log2l(1 - powl(g, 2 * (N - (long double)k)));
        const long double given = log2l(y.fraction[k]) + y.exponent[k];
        ck_assert_double_le((double)fabsl(given - exact), 1e-11);
        if (x[k] > 1e-300)
            ck_assert_double_le(fabs(iccp_scaled_get(&y, k, 0) - x[k]), 1e-12 * x[k]);
    }
    ck_assert_int_lt(y.exponent[N - 1], -37000);
    scaled_clear(&y);
    iccp_ldlt_free(&factor);
    system_clear(&s);
    free(edges);
    free(extra);
    free(b);
    free(x);
}
END_TEST

/* What nothing flows to is exactly 0. */
START_TEST(scaled_zeros_stay_zero)
{
    const edge edges[] = {{0, 1, 1}, {1, 2, 1}, {3, 4, 1}, {4, 5, 1}};
    const double extra[] = {1, 0, 0, 1, 0, 0}, b[] = {0, 0, 1, 0, 0, 0}, zero[6] = {0};
    equations s = from_edges(6, 4, edges, extra);
    iccp_ldlt factor = factorised(&s.m);
    iccp_scaled x = solve_scaled(&factor, b, -4000), y = solve_scaled(&factor, zero, 0);
    for (size_t i = 0; i < 6; ++i) {
        ck_assert((x.exponent[i] == ICCP_ZERO_EXPONENT) == (i >= 3));
        ck_assert(y.exponent[i] == ICCP_ZERO_EXPONENT);
    }
    scaled_clear(&x);
    scaled_clear(&y);
    iccp_ldlt_free(&factor);
    system_clear(&s);
}
END_TEST

int main(void)
{
    Suite *suite = suite_create("positive definite systems");
    TCase *tests = tcase_create("all");
    tcase_set_timeout(tests, 120);
    tcase_add_test(tests, grids_are_solved);
    tcase_add_test(tests, random_matrices_are_solved);
    tcase_add_test(tests, extreme_weights_are_solved_or_refused);
    tcase_add_loop_test(tests, mesh_laplacians_are_solved, 0, N_HARD_SHAPES);
    tcase_add_test(tests, nothing_and_one_row_are_solved);
    tcase_add_test(tests, other_matrices_are_refused);
    tcase_add_test(tests, failures_leave_nothing_behind);
    tcase_add_test(tests, scaled_solves_agree_with_plain_ones);
    tcase_add_test(tests, long_chains_do_not_underflow);
    tcase_add_test(tests, scaled_zeros_stay_zero);
    suite_add_tcase(suite, tests);
    return suite_run(suite);
}
