/* Bi-Laplace functions are the shapes of a plate under a load: f = c G e_root, with G the inverse of a
 * symmetric positive definite matrix, L L or A'A. A plate is highest beside a load that is not in the
 * middle. With G(t, r) > G(r, r) the inequality G(t, r)^2 <= G(t, t) G(r, r) gives G(t, t) > G(r, r): a load
 * that moves to the greatest value never comes back to where it was. */
#include "function/summit.h"

#include "solver/bilaplace.h"
#include "solver/energy.h"
#include "solver/laplacian_factor.h"

#include <string.h>

/* Far beyond what it takes (56 in the longest limbs tried): for rounding, which knows no proof. */
enum { MOST_MOVES = 1000 };

typedef struct plate {
    iccp_rows rows;
    int32_t function, solver;
    iccp_laplacian_factor laplacian; /* L: simply supported, direct */
    iccp_sparse a;                   /* A, A'A and its factor: clamped */
    iccp_gram gram;
    iccp_ldlt factor;
    double *f, *residual, *work, *wide; /* a number per row; the last one per row of A */
    int32_t *exponent;
    icc_field_info info; /* the solvers' accounts, which nobody asks for here */
} plate;

static icc_status prepare_clamped(plate *p, const iccp_env *env)
{
    icc_status status = iccp_energy_create(&p->a, &p->rows, p->function, env);
    if (status == ICC_OK)
        status = iccp_gram_create(&p->gram, &p->a, env);
    if (status != ICC_OK)
        return status;
    iccp_gram_fill(&p->gram, &p->a, NULL);
    p->wide = iccp_alloc(&env->memory, p->a.n_rows, sizeof *p->wide);
    status = p->wide != NULL ? iccp_ldlt_analyse(&p->factor, &p->gram.matrix, 1, env)
                             : ICC_ERR_MEMORY;
    return status == ICC_OK ? iccp_ldlt_factorise(&p->factor, &p->gram.matrix, env) : status;
}

static icc_status prepare(plate *p, const icc_field *field, const iccp_env *env)
{
    *p = (plate){.function = field->info.function,
                 .solver = field->info.solver,
                 .laplacian = {.memory = env->memory, .factor = {.memory = env->memory}},
                 .a = {.memory = env->memory},
                 .gram = {.memory = env->memory},
                 .factor = {.memory = env->memory}};
    const icc_status status = iccp_rows_create(&p->rows, field->tree, env);
    if (status != ICC_OK)
        return status;
    p->f = iccp_alloc(&env->memory, p->rows.n, sizeof *p->f);
    p->residual = iccp_alloc(&env->memory, p->rows.n, sizeof *p->residual);
    p->work = iccp_alloc(&env->memory, p->rows.n, sizeof *p->work);
    p->exponent = iccp_alloc(&env->memory, p->rows.n, sizeof *p->exponent);
    if (p->f == NULL || p->residual == NULL || p->work == NULL || p->exponent == NULL)
        return ICC_ERR_MEMORY;
    if (p->function == ICC_FUNCTION_CLAMPED)
        return prepare_clamped(p, env);
    return p->solver == ICC_SOLVER_DIRECT
               ? iccp_laplacian_factorise(&p->laplacian, &p->rows, &p->info, env)
               : ICC_OK;
}

static void dismiss(plate *p, const iccp_env *env)
{
    iccp_rows_free(&p->rows);
    iccp_laplacian_factor_free(&p->laplacian);
    iccp_sparse_free(&p->a);
    iccp_gram_free(&p->gram);
    iccp_ldlt_free(&p->factor);
    iccp_free(&env->memory, p->f);
    iccp_free(&env->memory, p->residual);
    iccp_free(&env->memory, p->work);
    iccp_free(&env->memory, p->wide);
    iccp_free(&env->memory, p->exponent);
}

/* The normal equations, corrected with the residual of the least squares problem as in energy.c. */
static void load_clamped(plate *p, size_t loaded)
{
    enum { CORRECTIONS = 2 };
    const size_t n = p->rows.n;
    p->f[loaded] = 1;
    iccp_ldlt_solve(&p->factor, 1, p->f, p->work);
    for (int i = 0; i < CORRECTIONS; ++i) {
        iccp_energy_gradient(&p->a, p->f, p->wide, p->residual);
        p->residual[loaded] -= 1;
        iccp_ldlt_solve(&p->factor, 1, p->residual, p->work);
        for (size_t k = 0; k < n; ++k)
            p->f[k] -= p->residual[k];
    }
}

/* f under a load on one row. What doubles do not hold is far below the greatest value. */
static icc_status load(plate *p, size_t loaded, const iccp_env *env)
{
    const size_t n = p->rows.n;
    memset(p->f, 0, n * sizeof *p->f);
    if (p->function == ICC_FUNCTION_CLAMPED) {
        load_clamped(p, loaded);
        return ICC_OK;
    }
    if (p->solver == ICC_SOLVER_DIRECT) {
        p->f[loaded] = 1;
        for (int pass = 0; pass < 2; ++pass)
            iccp_ldlt_solve(&p->laplacian.factor, 1, p->f, p->work);
        return ICC_OK;
    }
    const iccp_scaled scaled = {p->work, p->exponent};
    const icc_status status = iccp_bilaplace_iterative(&p->rows, loaded, &scaled, &p->info, env);
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        p->f[k] = iccp_scaled_get(&scaled, k, 0);
    return status;
}

/* Of several that are greatest, the first; `loaded` if that is one of them. */
static size_t find_highest(const plate *p, size_t loaded)
{
    size_t highest = loaded;
    for (size_t k = 0; k < p->rows.n; ++k)
        if (p->f[k] > p->f[highest])
            highest = k;
    return highest;
}

static icc_status climb(plate *p, size_t *row, const iccp_env *env)
{
    icc_status status = ICC_OK;
    size_t last = p->rows.n;
    for (int moves = 0; moves < MOST_MOVES && *row != last && status == ICC_OK; ++moves) {
        status = iccp_progress(env, "summit", (double)moves / (moves + 1));
        if (status == ICC_OK)
            status = load(p, *row, env);
        last = *row;
        if (status == ICC_OK)
            *row = find_highest(p, last);
    }
    return status;
}

icc_status iccp_field_summit(const icc_field *field, uint32_t *summit, const iccp_env *env)
{
    plate p;
    icc_status status = prepare(&p, field, env);
    if (status == ICC_OK) {
        size_t row = 0;
        while (p.rows.vertex[row] != field->info.highest)
            ++row;
        status = climb(&p, &row, env);
        *summit = p.rows.vertex[row];
    }
    dismiss(&p, env);
    return status;
}
