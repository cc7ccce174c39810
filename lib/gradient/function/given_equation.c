/* Solves Laplace's and bi-Laplace's equation with the caller's fixed values and right-hand side b.
 *
 * Both minimise 1/2 |A f - c|^2 - b'f over the free values. For Laplace, A f has the differences of
 * neighbours, and for bi-Laplace the Laplacian (gradient/solver/energy.h). c comes from the fixed
 * values g outside. The gradient is A'A f minus a force: b plus the sum of g over the neighbours
 * outside, or for bi-Laplace b plus the Laplacian of that sum. */
#include "gradient/function/given_equation.h"

#include "base/minmax.h"
#include "gradient/function/given_function.h"
#include "gradient/solver/energy.h"

#include <math.h>
#include <string.h>

typedef struct equation {
    const double *fixed, *right_side; /* by vertex, or NULL; the caller's */
    iccp_unknowns unknowns;
    iccp_sparse a;
    size_t n_free;
    uint32_t *variable;                   /* by unknown, as in iccp_reduction */
    double *numbers;                      /* memory of the next four arrays */
    double *share, *f, *force, *gradient; /* by unknown */
    double *work;                         /* by row of a */
    double *values;                       /* by vertex */
    iccp_solution info;
} equation;

static double fixed_at(const equation *e, uint32_t v)
{
    return e->fixed != NULL ? e->fixed[v] : NAN;
}

/* Returns the vertex outside next to unknown k in direction d, or ICCP_NONE. */
static uint32_t outside_at(const equation *e, size_t k, int32_t d)
{
    const iccp_unknowns *unknowns = &e->unknowns;
    if (unknowns->neighbour[k * (size_t)unknowns->n_neighbours + (size_t)d] != ICCP_NONE)
        return ICCP_NONE;
    return iccp_grid_neighbour(unknowns->tree->grid, unknowns->vertex[k], d / 2, 2 * (d % 2) - 1);
}

static icc_status allocate(equation *e, const iccp_env *env)
{
    const size_t n = e->unknowns.n;
    e->variable = iccp_alloc(&env->memory, n, sizeof *e->variable);
    e->numbers = iccp_alloc_zero(&env->memory, n, 4 * sizeof *e->numbers);
    e->work = iccp_alloc(&env->memory, e->a.n_rows, sizeof *e->work);
    e->values = iccp_alloc(&env->memory, e->unknowns.tree->grid->n_vertices, sizeof *e->values);
    if (e->variable == NULL || e->numbers == NULL || e->work == NULL || e->values == NULL)
        return ICC_ERR_MEMORY;
    e->share = e->numbers;
    e->f = e->numbers + n;
    e->force = e->numbers + 2 * n;
    e->gradient = e->numbers + 3 * n;
    return ICC_OK;
}

/* Sets the values outside, and numbers the free unknowns. */
static void take_fixed(equation *e)
{
    const iccp_unknowns *unknowns = &e->unknowns;
    for (uint32_t v = 0; v < unknowns->tree->grid->n_vertices; ++v)
        e->values[v] = fixed_at(e, v);
    for (size_t k = 0; k < unknowns->n; ++k) {
        const double value = fixed_at(e, unknowns->vertex[k]);
        e->share[k] = 1;
        e->f[k] = isnan(value) ? 0 : value;
        e->variable[k] = isnan(value) ? (uint32_t)e->n_free++ : ICCP_NONE;
        for (int32_t d = 0; d < unknowns->n_neighbours; ++d) {
            const uint32_t u = outside_at(e, k, d);
            if (u == ICCP_NONE)
                continue;
            if (isnan(e->values[u]))
                e->values[u] = 0;
            e->force[k] += e->values[u];
        }
    }
}

static void set_force(equation *e, int32_t function)
{
    const size_t n = e->unknowns.n;
    if (function == ICC_FUNCTION_BILAPLACE) {
        memcpy(e->gradient, e->force, n * sizeof *e->force);
        memset(e->force, 0, n * sizeof *e->force);
        iccp_sparse_apply_transpose(&e->a, e->gradient, e->force);
    }
    for (size_t k = 0; k < n && e->right_side != NULL; ++k)
        if (e->variable[k] != ICCP_NONE)
            e->force[k] += e->right_side[e->unknowns.vertex[k]];
}

/* Copies the solution to the vertices and finds the largest error. */
static icc_status take_solution(equation *e)
{
    iccp_energy_gradient(&e->a, e->f, e->work, e->gradient);
    for (size_t k = 0; k < e->unknowns.n; ++k) {
        if (!(fabs(e->f[k]) <= ICCP_MAX_VALUE))
            return ICC_ERR_SOLVER;
        e->values[e->unknowns.vertex[k]] = e->f[k];
        if (e->variable[k] != ICCP_NONE)
            e->info.residual = iccp_max(e->info.residual, fabs(e->gradient[k] - e->force[k]));
    }
    e->info.residual_before = e->info.residual;
    return ICC_OK;
}

static icc_status solve(equation *e, int32_t function, const iccp_env *env)
{
    icc_status status = iccp_energy_create(&e->a, &e->unknowns, function, env);
    if (status == ICC_OK)
        status = allocate(e, env);
    if (status != ICC_OK)
        return status;
    take_fixed(e);
    set_force(e, function);
    const iccp_reduction reduction = {e->n_free, e->variable, e->share};
    if (e->n_free > 0)
        status = iccp_energy_minimise(&e->a, &reduction, e->force, e->f, &e->info, env);
    return status == ICC_OK ? take_solution(e) : status;
}

/* Adds what the solver has found to what the values tell. */
static void report(icc_function *function, const equation *e, int32_t kind)
{
    iccp_solution info = e->info;
    info.function = kind;
    info.solver = ICC_SOLVER_DIRECT;
    info.n_unknowns = e->n_free;
    info.n_violated = function->info.n_violated;
    info.least_log = function->info.least_log;
    info.excess = function->info.excess;
    info.highest = function->info.highest;
    function->info = info;
}

icc_status iccp_function_solve(icc_function **out, const icc_tree *tree, int32_t function,
                               const double *fixed, const double *right_side, const iccp_env *env)
{
    equation e = {.fixed = fixed, .right_side = right_side, .a = {.memory = env->memory}};
    *out = NULL;
    icc_status status = iccp_unknowns_create(&e.unknowns, tree, env);
    if (status != ICC_OK)
        return status;
    status = solve(&e, function, env);
    if (status == ICC_OK)
        status = iccp_function_create_values(out, tree, e.values, env);
    if (status == ICC_OK)
        report(*out, &e, function);
    iccp_free(&env->memory, e.variable);
    iccp_free(&env->memory, e.numbers);
    iccp_free(&env->memory, e.work);
    iccp_free(&env->memory, e.values);
    iccp_sparse_free(&e.a);
    iccp_unknowns_free(&e.unknowns);
    return status;
}
