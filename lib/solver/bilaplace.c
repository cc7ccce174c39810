/* Based on: L. Huynh and Y. Gingold, Bijective Deformations in R^n via Integral Curve Coordinates,
 * section 5.2. Simply supported (Navier), the minimum satisfies L L f = 0 but at the root, so that two
 * solves with the M-matrix L give it; nothing cancels in them. Clamped, it is a least squares
 * problem with the Laplacians outside as further equations. */
#include "solver/bilaplace.h"

#include "base/clock.h"
#include "solver/dissection.h"
#include "solver/energy.h"
#include "solver/inequalities.h"
#include "math/ldlt.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Of a component, in its own size: far above the 1e-15 of solutions that are right, far below the 1 of
 * others. */
static const double MOST_RESIDUAL = 1e-6;

/* The Laplacian of the rows, the root's included. */
typedef struct laplacian {
    iccp_symmetric matrix;
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
} laplacian;

static void laplacian_free(laplacian *l, const iccp_env *env)
{
    iccp_free(&env->memory, l->first);
    iccp_free(&env->memory, l->column);
    iccp_free(&env->memory, l->value);
    iccp_free(&env->memory, l->diagonal);
}

static icc_status laplacian_create(laplacian *l, const iccp_rows *rows, const iccp_env *env)
{
    const size_t n = rows->n, degree = (size_t)rows->n_neighbours;
    l->first = iccp_alloc(&env->memory, n + 1, sizeof *l->first);
    l->column = iccp_alloc(&env->memory, n, degree * sizeof *l->column);
    l->value = iccp_alloc(&env->memory, n, degree * sizeof *l->value);
    l->diagonal = iccp_alloc(&env->memory, n, sizeof *l->diagonal);
    if (l->first == NULL || l->column == NULL || l->value == NULL || l->diagonal == NULL) {
        laplacian_free(l, env);
        return ICC_ERR_MEMORY;
    }
    size_t p = 0;
    for (size_t k = 0; k < n; ++k) {
        l->first[k] = p;
        l->diagonal[k] = (double)degree;
        for (size_t d = 0; d < degree; ++d)
            if (rows->neighbour[k * degree + d] != ICCP_NONE) {
                l->column[p] = rows->neighbour[k * degree + d];
                l->value[p++] = -1;
            }
    }
    l->first[n] = p;
    l->matrix = (iccp_symmetric){n, l->first, l->column, l->value, l->diagonal};
    return ICC_OK;
}

static icc_status analyse(iccp_ldlt *factor, const iccp_symmetric *matrix, const iccp_rows *rows,
                          const iccp_env *env)
{
    uint32_t *order = iccp_alloc(&env->memory, matrix->n, sizeof *order);
    if (order == NULL)
        return ICC_ERR_MEMORY;
    icc_status status = iccp_dissection(rows, order, env);
    if (status == ICC_OK)
        status = iccp_ldlt_analyse_ordered(factor, matrix, order, env);
    iccp_free(&env->memory, order);
    return status;
}

static icc_status factorise(iccp_ldlt *factor, const iccp_symmetric *matrix, const iccp_rows *rows,
                            icc_function_info *info, const iccp_env *env)
{
    double start = iccp_seconds();
    icc_status status = analyse(factor, matrix, rows, env);
    info->seconds_order += iccp_seconds() - start;
    if (status != ICC_OK)
        return status;
    info->work = fmax(info->work, factor->work);
    start = iccp_seconds();
    status = iccp_ldlt_factorise(factor, matrix, env);
    info->seconds_factor += iccp_seconds() - start;
    if (status != ICC_OK)
        iccp_ldlt_free(factor);
    return status;
}

/* Divides by the value of the root, which becomes 1. */
static void scale(const iccp_scaled *f, size_t n)
{
    const double root = f->fraction[0];
    const int32_t exponent = f->exponent[0];
    for (size_t k = 0; k < n; ++k)
        if (f->exponent[k] != ICCP_ZERO_EXPONENT)
            iccp_scaled_set(f, k, f->fraction[k] / root, f->exponent[k] - exponent);
}

/* ICC_ERR_SOLVER unless every component of L x = b is about what it should be. */
static icc_status check_solution(const iccp_rows *rows, const iccp_scaled *x, const iccp_scaled *b,
                                 const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; k < rows->n && status == ICC_OK; ++k) {
        const int32_t unit = x->exponent[k];
        if (k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "check", (double)k / (double)rows->n);
        const double r = iccp_laplacian_row(rows, x, k, unit) - iccp_scaled_get(b, k, unit);
        if (!(fabs(r) <= MOST_RESIDUAL * rows->n_neighbours * x->fraction[k]))
            return ICC_ERR_SOLVER;
    }
    return status;
}

/* L f = b. Takes f over into b if it is good. `work` is room. */
static icc_status solve(const iccp_rows *rows, const iccp_ldlt *factor, const iccp_scaled *b,
                        const iccp_scaled *f, const iccp_scaled *work, const iccp_env *env)
{
    const size_t n = rows->n;
    memcpy(f->fraction, b->fraction, n * sizeof *f->fraction);
    memcpy(f->exponent, b->exponent, n * sizeof *f->exponent);
    icc_status status = iccp_ldlt_solve_scaled(factor, f, work, env);
    if (status == ICC_OK)
        status = check_solution(rows, f, b, env);
    if (status != ICC_OK)
        return status;
    memcpy(b->fraction, f->fraction, n * sizeof *f->fraction);
    memcpy(b->exponent, f->exponent, n * sizeof *f->exponent);
    return ICC_OK;
}

static icc_status solve_twice(const iccp_rows *rows, const iccp_ldlt *factor, const iccp_scaled *f,
                              const iccp_env *env)
{
    const size_t n = rows->n;
    double *fraction = iccp_alloc(&env->memory, 2 * n, sizeof *fraction);
    int32_t *exponent = iccp_alloc(&env->memory, 2 * n, sizeof *exponent);
    icc_status status = fraction != NULL && exponent != NULL ? ICC_OK : ICC_ERR_MEMORY;
    const iccp_scaled b = {fraction, exponent};
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        iccp_scaled_set(&b, k, k == 0, 0);
    for (int pass = 0; pass < 2 && status == ICC_OK; ++pass) {
        status = iccp_progress(env, "bi-Laplace", 0.5 * pass);
        const iccp_scaled work = {fraction + n, exponent + n};
        if (status == ICC_OK)
            status = solve(rows, factor, &b, f, &work, env);
    }
    iccp_free(&env->memory, fraction);
    iccp_free(&env->memory, exponent);
    return status;
}

static icc_status navier_direct(const iccp_rows *rows, const iccp_scaled *f, icc_function_info *info,
                                const iccp_env *env)
{
    double start = iccp_seconds();
    laplacian l;
    iccp_ldlt factor;
    icc_status status = laplacian_create(&l, rows, env);
    if (status != ICC_OK)
        return status;
    info->seconds_setup += iccp_seconds() - start;
    status = factorise(&factor, &l.matrix, rows, info, env);
    if (status == ICC_OK) {
        start = iccp_seconds();
        status = solve_twice(rows, &factor, f, env);
        info->seconds_solve += iccp_seconds() - start;
        iccp_ldlt_free(&factor);
    }
    laplacian_free(&l, env);
    if (status == ICC_OK)
        scale(f, rows->n);
    return status;
}

/* Unknowns: all rows but the root. */
static icc_status clamped(const iccp_rows *rows, const iccp_sparse *a, double *f, icc_function_info *info,
                          const iccp_env *env)
{
    const size_t n = rows->n;
    uint32_t *unknown = iccp_alloc(&env->memory, n, sizeof *unknown);
    double *share = iccp_alloc(&env->memory, n, sizeof *share);
    icc_status status = ICC_ERR_MEMORY;
    if (unknown != NULL && share != NULL) {
        for (uint32_t k = 0; k < n; ++k) {
            unknown[k] = k == 0 ? ICCP_NONE : k - 1;
            share[k] = 1;
        }
        const iccp_reduction all = {n - 1, unknown, share};
        f[0] = 1;
        status = iccp_energy_minimise(a, &all, f, info, env);
    }
    iccp_free(&env->memory, unknown);
    iccp_free(&env->memory, share);
    return status;
}

/* The largest |A'A f| but for the root's. */
static icc_status find_residual(const iccp_sparse *a, const double *f, icc_function_info *info,
                                const iccp_env *env)
{
    double *work = iccp_alloc(&env->memory, a->n_rows, sizeof *work);
    double *gradient = iccp_alloc(&env->memory, a->n_columns, sizeof *gradient);
    const icc_status status = work != NULL && gradient != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        iccp_energy_gradient(a, f, work, gradient);
        info->residual = 0;
        for (size_t k = 1; k < a->n_columns; ++k)
            info->residual = fmax(info->residual, fabs(gradient[k]));
        info->residual_before = info->residual;
    }
    iccp_free(&env->memory, work);
    iccp_free(&env->memory, gradient);
    return status;
}

icc_status iccp_bilaplace(const iccp_rows *rows, int32_t function, int32_t solver,
                          const iccp_scaled *f, icc_function_info *info, const iccp_env *env)
{
    const size_t n = rows->n;
    double start = iccp_seconds();
    iccp_sparse a;
    icc_status status = iccp_energy_create(&a, rows, function, env);
    if (status != ICC_OK)
        return status;
    info->seconds_setup += iccp_seconds() - start;
    double *plain = iccp_alloc(&env->memory, n, sizeof *plain);
    if (plain == NULL)
        status = ICC_ERR_MEMORY;
    else if (function == ICC_FUNCTION_CLAMPED)
        status = clamped(rows, &a, plain, info, env);
    else if (solver == ICC_SOLVER_ITERATIVE)
        status = iccp_bilaplace_iterative(rows, f, info, env);
    else
        status = navier_direct(rows, f, info, env);
    start = iccp_seconds();
    for (size_t k = 0; k < n && status == ICC_OK; ++k) {
        if (function == ICC_FUNCTION_CLAMPED)
            iccp_scaled_set(f, k, plain[k], 0);
        else
            plain[k] = iccp_scaled_get(f, k, 0);
    }
    if (status == ICC_OK)
        status = find_residual(&a, plain, info, env);
    info->seconds_verify += iccp_seconds() - start;
    iccp_free(&env->memory, plain);
    iccp_sparse_free(&a);
    return status;
}
