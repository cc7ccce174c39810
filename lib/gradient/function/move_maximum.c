/* Moves the maximum of a bi-Laplace function to where the load is. These functions are the shapes
 * of a plate under a load: f = c G e_root, where G is the inverse of a symmetric positive definite
 * matrix, L L or A'A. If the load is not in the middle, the plate is highest beside it.
 *
 * Suppose that G(t, r) > G(r, r). Then the inequality G(t, r)^2 <= G(t, t) G(r, r) gives G(t, t) >
 * G(r, r). So a load that moves to the greatest value never returns to an earlier place. The same
 * holds if it moves further, as long as G(r, r) grows. */
#include "gradient/function/move_maximum.h"

#include "gradient/solver/bilaplace.h"
#include "gradient/solver/energy.h"
#include "gradient/solver/laplacian_factor.h"

#include <string.h>

/* Far more than necessary. The limit is for rounding, which the proof does not cover. */
enum { MOST_LOADS = 1000 };

typedef struct plate {
    iccp_unknowns unknowns;
    int32_t function, solver;
    iccp_laplacian_factor laplacian; /* L: simply supported, direct */
    iccp_sparse a;                   /* A, A'A and its factor: clamped */
    iccp_gram gram;
    iccp_ldlt factor;
    double *f, *residual, *work, *wide; /* a number per unknown; the last one: per row of A */
    int32_t *exponent;                  /* per unknown */
    iccp_solution info;                 /* the solvers' report; not used here */
} plate;

static icc_status prepare_clamped(plate *p, const iccp_env *env)
{
    icc_status status = iccp_energy_create(&p->a, &p->unknowns, p->function, env);
    if (status == ICC_OK)
        status = iccp_gram_create(&p->gram, &p->a, env);
    if (status != ICC_OK)
        return status;
    iccp_gram_fill(&p->gram, &p->a, NULL);
    p->wide = iccp_alloc(&env->memory, p->a.n_rows, sizeof *p->wide);
    status =
        p->wide != NULL ? iccp_ldlt_analyse(&p->factor, &p->gram.matrix, 1, env) : ICC_ERR_MEMORY;
    return status == ICC_OK ? iccp_ldlt_factorise(&p->factor, &p->gram.matrix, env) : status;
}

/* Prepares what every load needs: a factor of L, or of A'A when clamped. The iterative solver
 * prepares itself for each load. On failure, free_plate() still frees the plate. */
static icc_status prepare_plate(plate *p, const icc_function *function, const iccp_env *env)
{
    *p = (plate){.function = function->info.function,
                 .solver = function->info.solver,
                 .laplacian = {.memory = env->memory, .factor = {.memory = env->memory}},
                 .a = {.memory = env->memory},
                 .gram = {.memory = env->memory},
                 .factor = {.memory = env->memory}};
    const icc_status status = iccp_unknowns_create(&p->unknowns, function->tree, env);
    if (status != ICC_OK)
        return status;
    p->f = iccp_alloc(&env->memory, p->unknowns.n, sizeof *p->f);
    p->residual = iccp_alloc(&env->memory, p->unknowns.n, sizeof *p->residual);
    p->work = iccp_alloc(&env->memory, p->unknowns.n, sizeof *p->work);
    p->exponent = iccp_alloc(&env->memory, p->unknowns.n, sizeof *p->exponent);
    if (p->f == NULL || p->residual == NULL || p->work == NULL || p->exponent == NULL)
        return ICC_ERR_MEMORY;
    if (p->function == ICC_FUNCTION_CLAMPED)
        return prepare_clamped(p, env);
    return p->solver == ICC_SOLVER_DIRECT
               ? iccp_laplacian_factorise(&p->laplacian, &p->unknowns, &p->info, env)
               : ICC_OK;
}

static void free_plate(plate *p, const iccp_env *env)
{
    iccp_unknowns_free(&p->unknowns);
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

/* Solves the normal equations, corrected with the residual of the least squares problem as in
 * energy.c. */
static void load_clamped(plate *p, size_t loaded)
{
    enum { CORRECTIONS = 2 };
    const size_t n = p->unknowns.n;
    iccp_ldlt_solve(&p->factor, 1, p->f, p->work);
    for (int i = 0; i < CORRECTIONS; ++i) {
        iccp_energy_gradient(&p->a, p->f, p->wide, p->residual);
        p->residual[loaded] -= 1;
        iccp_ldlt_solve(&p->factor, 1, p->residual, p->work);
        for (size_t k = 0; k < n; ++k)
            p->f[k] -= p->residual[k];
    }
}

/* Computes f under a load on one unknown, where f is 1. Values too small for doubles are far below
 * the greatest value. */
static icc_status load_plate(plate *p, size_t loaded, const iccp_env *env)
{
    const size_t n = p->unknowns.n;
    if (p->function != ICC_FUNCTION_CLAMPED && p->solver == ICC_SOLVER_ITERATIVE) {
        const iccp_scaled f = {p->work, p->exponent};
        const icc_status status = iccp_bilaplace_iterative(&p->unknowns, loaded, &f, &p->info, env);
        for (size_t k = 0; k < n && status == ICC_OK; ++k)
            p->f[k] = iccp_scaled_get(&f, k, 0);
        return status;
    }
    memset(p->f, 0, n * sizeof *p->f);
    p->f[loaded] = 1;
    if (p->function == ICC_FUNCTION_CLAMPED)
        load_clamped(p, loaded);
    else
        for (int pass = 0; pass < 2; ++pass)
            iccp_ldlt_solve(&p->laplacian.factor, 1, p->f, p->work);
    const double unit = p->f[loaded];
    for (size_t k = 0; k < n; ++k)
        p->f[k] /= unit;
    return ICC_OK;
}

/* Returns the first greatest unknown, or `loaded` if that is one of them. */
static size_t find_highest(const plate *p, size_t loaded)
{
    size_t highest = loaded;
    for (size_t k = 0; k < p->unknowns.n; ++k)
        if (p->f[k] > p->f[highest])
            highest = k;
    return highest;
}

static size_t find_unknown(const plate *p, uint32_t vertex)
{
    size_t unknown = 0;
    while (unknown < p->unknowns.n && p->unknowns.vertex[unknown] != vertex)
        ++unknown;
    return unknown;
}

/* Returns the unknown in the direction of `to`, `stride` times as far from `from`. Returns `to` if
 * there is none. */
static size_t find_beyond(const plate *p, size_t from, size_t to, int64_t stride)
{
    const icc_grid *grid = p->unknowns.tree->grid;
    uint32_t vertex = 0;
    for (int32_t k = 0; k < grid->dim; ++k) {
        const int64_t x = iccp_grid_coordinate(grid, p->unknowns.vertex[from], k);
        const int64_t y = iccp_grid_coordinate(grid, p->unknowns.vertex[to], k);
        const int64_t z = x + stride * (y - x);
        if (z < 0 || z >= (int64_t)grid->shape[k])
            return to;
        vertex += (uint32_t)z * (uint32_t)grid->stride[k];
    }
    const size_t unknown = find_unknown(p, vertex);
    return unknown < p->unknowns.n ? unknown : to;
}

/* Moves the load. Steps grow as long as G(r, r) of the loaded unknown r grows. In a limb that
 * widens slowly, the greatest value is always near the load. With f = 1 at each load, G(s, s) /
 * G(r, r) = f_r(s) / f_s(r). */
static icc_status follow_loads(plate *p, size_t *unknown, const iccp_env *env)
{
    size_t at = *unknown, next = at, top = at;
    double before = 1; /* f at `next` under the load that was accepted last */
    int64_t stride = 1;
    for (int n = 0; n < MOST_LOADS; ++n) {
        icc_status status = iccp_progress(env, "solve", (double)n / (n + 1));
        if (status == ICC_OK)
            status = load_plate(p, next, env);
        if (status != ICC_OK)
            return status;
        if (next == top || before > p->f[at]) {
            stride = next == at ? 1 : 2 * stride;
            at = next;
            top = find_highest(p, at);
            *unknown = top;
            if (top == at)
                break;
            next = find_beyond(p, at, top, stride);
            before = p->f[next];
        } else {
            next = top;
            stride = 1;
        }
    }
    return ICC_OK;
}

icc_status iccp_function_move_maximum(const icc_function *function, uint32_t *maximum,
                                      const iccp_env *env)
{
    plate p;
    icc_status status = prepare_plate(&p, function, env);
    if (status == ICC_OK) {
        size_t unknown = find_unknown(&p, function->info.highest);
        status = follow_loads(&p, &unknown, env);
        *maximum = p.unknowns.vertex[unknown];
    }
    free_plate(&p, env);
    return status;
}
