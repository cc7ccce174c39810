/* Least squares by the normal equations, corrected with the residual of the least squares problem:
 * A. Bjorck, Stability analysis of the method of seminormal equations for linear least squares
 * problems, Linear Algebra Appl. 88/89, 1987. */
#include "gradient/solver/energy.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "math/ldlt.h"

#include <math.h>
#include <string.h>

/* A smaller correction, relative to the solution, is rounding. */
static const double SMALL_CORRECTION = 1e-15;

static uint32_t neighbour(const iccp_unknowns *unknowns, size_t k, int32_t d)
{
    return unknowns->neighbour[k * (size_t)unknowns->n_neighbours + (size_t)d];
}

/* Returns the vertex outside next to unknown k, or ICCP_NONE outside the grid. */
static uint32_t vertex_outside(const iccp_unknowns *unknowns, size_t k, int32_t d)
{
    return iccp_grid_neighbour(unknowns->tree->grid, unknowns->vertex[k], d / 2, 2 * (d % 2) - 1);
}

static void count_neighbours(const iccp_unknowns *unknowns, size_t *n_inside, size_t *n_outside)
{
    const size_t n = unknowns->n * (size_t)unknowns->n_neighbours;
    *n_outside = 0;
    for (size_t i = 0; i < n; ++i)
        *n_outside += unknowns->neighbour[i] == ICCP_NONE;
    *n_inside = n - *n_outside;
}

static void set_inside(iccp_sparse *a, const iccp_unknowns *unknowns)
{
    size_t p = 0;
    for (uint32_t k = 0; k < unknowns->n; ++k) {
        a->first[k] = p;
        a->column[p] = k;
        a->value[p++] = unknowns->n_neighbours;
        for (int32_t d = 0; d < unknowns->n_neighbours; ++d)
            if (neighbour(unknowns, k, d) != ICCP_NONE) {
                a->column[p] = neighbour(unknowns, k, d);
                a->value[p++] = -1;
            }
    }
    a->first[unknowns->n] = p;
}

/* Returns the row of A for the vertex outside next to unknown k. The first call for a vertex gives
 * it a number. A vertex outside the grid has one neighbour inside, so it is met only once. */
static size_t row_outside(iccp_sparse *a, const iccp_unknowns *unknowns, uint32_t *row_of, size_t k,
                          int32_t d)
{
    const uint32_t u = vertex_outside(unknowns, k, d);
    if (u == ICCP_NONE)
        return a->n_rows++;
    if (row_of[u] == ICCP_NONE)
        row_of[u] = (uint32_t)a->n_rows++;
    return row_of[u];
}

/* Makes two passes over the neighbours outside, which number them in the same way. The first counts
 * the entries of their rows, the second writes them. */
static icc_status set_outside(iccp_sparse *a, const iccp_unknowns *unknowns, const iccp_env *env)
{
    const size_t n = unknowns->n, n_vertices = unknowns->tree->grid->n_vertices, most = a->n_rows;
    uint32_t *row_of = iccp_alloc(&env->memory, n_vertices, sizeof *row_of);
    if (row_of == NULL)
        return ICC_ERR_MEMORY;
    memset(a->first + n + 1, 0, (most - n) * sizeof *a->first);
    for (int pass = 0; pass < 2; ++pass) {
        memset(row_of, 0xff, n_vertices * sizeof *row_of); /* ICCP_NONE */
        a->n_rows = n;
        for (uint32_t k = 0; k < n; ++k)
            for (int32_t d = 0; d < unknowns->n_neighbours; ++d) {
                if (neighbour(unknowns, k, d) != ICCP_NONE)
                    continue;
                const size_t i = row_outside(a, unknowns, row_of, k, d);
                if (pass == 0) {
                    ++a->first[i + 1];
                } else {
                    a->column[a->first[i]] = k;
                    a->value[a->first[i]++] = -1;
                }
            }
        for (size_t i = n; pass == 0 && i < a->n_rows; ++i)
            a->first[i + 1] += a->first[i];
    }
    /* Filling has moved the beginning of each row to its end. */
    for (size_t i = a->n_rows; i > n; --i)
        a->first[i] = a->first[i - 1];
    size_t n_inside, n_outside;
    count_neighbours(unknowns, &n_inside, &n_outside);
    a->first[n] = n + n_inside;
    iccp_free(&env->memory, row_of);
    return ICC_OK;
}

static icc_status create_differences(iccp_sparse *a, const iccp_unknowns *unknowns,
                                     const iccp_env *env)
{
    size_t n_inside, n_outside, row = 0, p = 0;
    count_neighbours(unknowns, &n_inside, &n_outside);
    const icc_status status =
        iccp_sparse_create(a, n_inside / 2 + n_outside, unknowns->n, n_inside + n_outside, env);
    if (status != ICC_OK)
        return status;
    for (uint32_t k = 0; k < unknowns->n; ++k)
        for (int32_t d = 0; d < unknowns->n_neighbours; ++d) {
            const uint32_t j = neighbour(unknowns, k, d);
            if (j != ICCP_NONE && j < k)
                continue;
            a->first[row++] = p;
            a->column[p] = k;
            a->value[p++] = 1;
            if (j != ICCP_NONE) {
                a->column[p] = j;
                a->value[p++] = -1;
            }
        }
    a->first[row] = p;
    return ICC_OK;
}

icc_status iccp_energy_create(iccp_sparse *a, const iccp_unknowns *unknowns, int32_t function,
                              const iccp_env *env)
{
    size_t n_inside, n_outside;
    if (function == ICC_FUNCTION_LAPLACE)
        return create_differences(a, unknowns, env);
    count_neighbours(unknowns, &n_inside, &n_outside);
    if (function != ICC_FUNCTION_CLAMPED)
        n_outside = 0;
    icc_status status = iccp_sparse_create(a, unknowns->n + n_outside, unknowns->n,
                                           unknowns->n + n_inside + n_outside, env);
    if (status != ICC_OK)
        return status;
    set_inside(a, unknowns);
    if (n_outside > 0)
        status = set_outside(a, unknowns, env);
    if (status != ICC_OK)
        iccp_sparse_free(a);
    return status;
}

void iccp_energy_gradient(const iccp_sparse *a, const double *f, double *work, double *out)
{
    iccp_sparse_apply(a, f, NULL, work);
    memset(out, 0, a->n_columns * sizeof *out);
    iccp_sparse_apply_transpose(a, work, out);
}

/* Computes B = A P: adds up the columns of A that share a variable. */
static icc_status reduce(iccp_sparse *b, const iccp_sparse *a, const iccp_reduction *reduction,
                         const iccp_env *env)
{
    const icc_status status =
        iccp_sparse_create(b, a->n_rows, reduction->n_variables, a->first[a->n_rows], env);
    if (status != ICC_OK)
        return status;
    size_t end = 0;
    for (size_t i = 0; i < a->n_rows; ++i) {
        b->first[i] = end;
        for (size_t p = a->first[i]; p < a->first[i + 1]; ++p) {
            const uint32_t u = reduction->variable[a->column[p]];
            if (u == ICCP_NONE)
                continue;
            size_t q = b->first[i];
            while (q < end && b->column[q] != u)
                ++q;
            if (q == end) {
                b->column[end] = u;
                b->value[end++] = 0;
            }
            b->value[q] += a->value[p] * reduction->share[a->column[p]];
        }
    }
    b->first[a->n_rows] = end;
    return ICC_OK;
}

typedef struct least_squares {
    const iccp_sparse *a;
    const iccp_reduction *reduction;
    const double *force; /* by unknown, or NULL */
    iccp_sparse b;
    iccp_gram gram;
    iccp_ldlt factor;
    double *residual;        /* by row of A */
    double *x, *step, *work; /* by variable */
} least_squares;

static void expand(const least_squares *s, double *f)
{
    for (size_t k = 0; k < s->a->n_columns; ++k)
        if (s->reduction->variable[k] != ICCP_NONE)
            f[k] = s->reduction->share[k] * s->x[s->reduction->variable[k]];
}

/* Makes one correction. Returns its size relative to the solution. */
static double correct(const least_squares *s, double *f)
{
    const size_t n = s->b.n_columns;
    iccp_sparse_apply(s->a, f, NULL, s->residual);
    memset(s->step, 0, n * sizeof *s->step);
    iccp_sparse_apply_transpose(&s->b, s->residual, s->step);
    for (size_t k = 0; s->force != NULL && k < s->a->n_columns; ++k)
        if (s->reduction->variable[k] != ICCP_NONE)
            s->step[s->reduction->variable[k]] -= s->reduction->share[k] * s->force[k];
    iccp_ldlt_solve(&s->factor, 1, s->step, s->work);
    double largest = 0, size = 0;
    for (size_t u = 0; u < n; ++u) {
        s->x[u] -= s->step[u];
        largest = iccp_max(largest, fabs(s->step[u]));
        size = iccp_max(size, fabs(s->x[u]));
    }
    expand(s, f);
    return size > 0 ? largest / size : 0.0;
}

static icc_status solve(const least_squares *s, double *f, const iccp_env *env)
{
    double last, size = HUGE_VAL;
    memset(s->x, 0, s->b.n_columns * sizeof *s->x);
    expand(s, f);
    (void)correct(s, f); /* yields the solution itself */
    do {
        last = size;
        size = correct(s, f);
    } while (size > SMALL_CORRECTION && size < 0.5 * last);
    if (size < ICCP_MOST_ERROR)
        return ICC_OK;
    iccp_log(env, "least energy: the solution is uncertain by %.1e of itself", size);
    return ICC_ERR_SOLVER;
}

/* Makes B = A P and factorises B'B. correct() restores the digits that are lost by squaring, so the
 * normal equations suffice. */
static icc_status factorise(least_squares *s, iccp_solution *info, const iccp_env *env)
{
    double start = iccp_seconds();
    icc_status status = reduce(&s->b, s->a, s->reduction, env);
    if (status == ICC_OK)
        status = iccp_gram_create(&s->gram, &s->b, env);
    if (status != ICC_OK)
        return status;
    iccp_gram_fill(&s->gram, &s->b, NULL);
    info->seconds_setup += iccp_seconds() - start;
    start = iccp_seconds();
    status = iccp_ldlt_analyse(&s->factor, &s->gram.matrix, 1, env);
    info->seconds_order += iccp_seconds() - start;
    if (status != ICC_OK)
        return status;
    info->work = iccp_max(info->work, s->factor.work);
    start = iccp_seconds();
    status = iccp_ldlt_factorise(&s->factor, &s->gram.matrix, env);
    info->seconds_factor += iccp_seconds() - start;
    return status;
}

icc_status iccp_energy_minimise(const iccp_sparse *a, const iccp_reduction *reduction,
                                const double *force, double *f, iccp_solution *info,
                                const iccp_env *env)
{
    least_squares s = {.a = a, .reduction = reduction, .force = force};
    const size_t n = reduction->n_variables;
    s.residual = iccp_alloc(&env->memory, a->n_rows, sizeof *s.residual);
    s.x = iccp_alloc(&env->memory, n, sizeof *s.x);
    s.step = iccp_alloc(&env->memory, n, sizeof *s.step);
    s.work = iccp_alloc(&env->memory, n, sizeof *s.work);
    s.b.memory = s.gram.memory = s.factor.memory = env->memory;
    icc_status status = ICC_ERR_MEMORY;
    if (s.residual != NULL && s.x != NULL && s.step != NULL && s.work != NULL)
        status = factorise(&s, info, env);
    const double start = iccp_seconds();
    if (status == ICC_OK)
        status = solve(&s, f, env);
    info->seconds_solve += iccp_seconds() - start;
    iccp_free(&env->memory, s.residual);
    iccp_free(&env->memory, s.x);
    iccp_free(&env->memory, s.step);
    iccp_free(&env->memory, s.work);
    iccp_sparse_free(&s.b);
    iccp_gram_free(&s.gram);
    iccp_ldlt_free(&s.factor);
    return status;
}
