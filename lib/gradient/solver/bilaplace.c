/* Bi-Laplace functions without inequalities. Based on: L. Huynh and Y. Gingold, Bijective
 * Deformations in R^n via Integral Curve Coordinates, section 5.2.
 *
 * Simply supported (Navier), the minimum satisfies L L f = 0 except at the root. So two solves with
 * the M-matrix L give it, and nothing cancels in them. Clamped, it is a least squares problem, with
 * the Laplacians outside as further equations. */
#include "gradient/solver/bilaplace.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "gradient/solver/energy.h"
#include "gradient/solver/inequalities.h"
#include "gradient/solver/laplacian_factor.h"

#include <assert.h>
#include <math.h>
#include <string.h>

/* Divides by the value at the root, which becomes 1. */
static void scale(const iccp_scaled *f, size_t n)
{
    const double root = f->fraction[0];
    const int32_t exponent = f->exponent[0];
    for (size_t k = 0; k < n; ++k)
        iccp_scaled_set(f, k, f->fraction[k] / root, f->exponent[k] - exponent);
}

/* Returns ICC_ERR_SOLVER unless every component of L x = b holds approximately. */
static icc_status check_solution(const iccp_unknowns *unknowns, const iccp_scaled *x,
                                 const iccp_scaled *b, const iccp_env *env)
{
    icc_status status = ICC_OK;
    for (size_t k = 0; k < unknowns->n && status == ICC_OK; ++k) {
        const int32_t unit = x->exponent[k];
        if (k % ICCP_VERTICES_PER_REPORT == 0)
            status = iccp_progress(env, "solve", (double)k / (double)unknowns->n);
        const double r = iccp_laplacian_row(unknowns, x, k, unit) - iccp_scaled_get(b, k, unit);
        if (!(fabs(r) <= ICCP_MOST_ERROR * unknowns->n_neighbours * x->fraction[k]))
            return ICC_ERR_SOLVER;
    }
    return status;
}

/* Solves L f = b and copies f into b if it is accurate. `work` is workspace. */
static icc_status solve(const iccp_unknowns *unknowns, const iccp_ldlt *factor,
                        const iccp_scaled *b, const iccp_scaled *f, const iccp_scaled *work,
                        const iccp_env *env)
{
    const size_t n = unknowns->n;
    memcpy(f->fraction, b->fraction, n * sizeof *f->fraction);
    memcpy(f->exponent, b->exponent, n * sizeof *f->exponent);
    icc_status status = iccp_ldlt_solve_scaled(factor, f, work, env);
    if (status == ICC_OK)
        status = check_solution(unknowns, f, b, env);
    if (status != ICC_OK)
        return status;
    memcpy(b->fraction, f->fraction, n * sizeof *f->fraction);
    memcpy(b->exponent, f->exponent, n * sizeof *f->exponent);
    return ICC_OK;
}

static icc_status solve_twice(const iccp_unknowns *unknowns, const iccp_ldlt *factor,
                              const iccp_scaled *f, const iccp_env *env)
{
    const size_t n = unknowns->n;
    double *fraction = iccp_alloc(&env->memory, 2 * n, sizeof *fraction);
    int32_t *exponent = iccp_alloc(&env->memory, 2 * n, sizeof *exponent);
    icc_status status = fraction != NULL && exponent != NULL ? ICC_OK : ICC_ERR_MEMORY;
    const iccp_scaled b = {fraction, exponent};
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        iccp_scaled_set(&b, k, k == 0, 0);
    for (int pass = 0; pass < 2 && status == ICC_OK; ++pass) {
        status = iccp_progress(env, "solve", 0.5 * pass);
        const iccp_scaled work = {fraction + n, exponent + n};
        if (status == ICC_OK)
            status = solve(unknowns, factor, &b, f, &work, env);
    }
    iccp_free(&env->memory, fraction);
    iccp_free(&env->memory, exponent);
    return status;
}

static icc_status navier_direct(const iccp_unknowns *unknowns, const iccp_scaled *f,
                                iccp_solution *info, const iccp_env *env)
{
    iccp_laplacian_factor l;
    const icc_status created = iccp_laplacian_factorise(&l, unknowns, info, env);
    if (created != ICC_OK)
        return created;
    const double start = iccp_seconds();
    const icc_status status = solve_twice(unknowns, &l.factor, f, env);
    info->seconds_solve += iccp_seconds() - start;
    iccp_laplacian_factor_free(&l);
    if (status == ICC_OK)
        scale(f, unknowns->n);
    return status;
}

/* All unknowns except the root are free variables. */
static icc_status clamped(const iccp_unknowns *unknowns, const iccp_sparse *a, double *f,
                          iccp_solution *info, const iccp_env *env)
{
    const size_t n = unknowns->n;
    uint32_t *variable = iccp_alloc(&env->memory, n, sizeof *variable);
    double *share = iccp_alloc(&env->memory, n, sizeof *share);
    icc_status status = ICC_ERR_MEMORY;
    if (variable != NULL && share != NULL) {
        for (uint32_t k = 0; k < n; ++k) {
            variable[k] = k == 0 ? ICCP_NONE : k - 1;
            share[k] = 1;
        }
        const iccp_reduction all = {n - 1, variable, share};
        f[0] = 1;
        status = iccp_energy_minimise(a, &all, NULL, f, info, env);
    }
    iccp_free(&env->memory, variable);
    iccp_free(&env->memory, share);
    return status;
}

/* Finds the largest |A'A f|, except the root's. */
static icc_status find_residual(const iccp_sparse *a, const double *f, iccp_solution *info,
                                const iccp_env *env)
{
    double *work = iccp_alloc(&env->memory, a->n_rows, sizeof *work);
    double *gradient = iccp_alloc(&env->memory, a->n_columns, sizeof *gradient);
    const icc_status status = work != NULL && gradient != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        iccp_energy_gradient(a, f, work, gradient);
        info->residual = 0;
        for (size_t k = 1; k < a->n_columns; ++k)
            info->residual = iccp_max(info->residual, fabs(gradient[k]));
        info->residual_before = info->residual;
    }
    iccp_free(&env->memory, work);
    iccp_free(&env->memory, gradient);
    return status;
}

icc_status iccp_bilaplace(const iccp_unknowns *unknowns, int32_t function, int32_t solver,
                          const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    const size_t n = unknowns->n;
    double start = iccp_seconds();
    iccp_sparse a;
    icc_status status = iccp_energy_create(&a, unknowns, function, env);
    if (status != ICC_OK)
        return status;
    info->seconds_setup += iccp_seconds() - start;
    double *plain = iccp_alloc(&env->memory, n, sizeof *plain);
    if (plain == NULL)
        status = ICC_ERR_MEMORY;
    else if (function == ICC_FUNCTION_CLAMPED)
        status = clamped(unknowns, &a, plain, info, env);
    else if (solver == ICC_SOLVER_ITERATIVE)
        status = iccp_bilaplace_iterative(unknowns, 0, f, info, env);
    else
        status = navier_direct(unknowns, f, info, env);
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
