/* Block principal pivoting: L. Portugal, J. Judice, L. Vicente, A comparison of block pivoting and
 * interior-point algorithms for linear least squares problems with nonnegative variables, Math.
 * Comput. 63, 1994.
 *
 * Each value is free, or fixed at one of its bounds. With the fixed values, one linear system gives
 * the free ones. A free value beyond a bound is wrong, and a fixed value whose force points inward
 * is wrong. All wrong values change their state at once, which usually takes few rounds but may
 * repeat itself. If several rounds in a row do not lower the number of wrong values, only the last
 * one changes. Single changes never repeat themselves, so the method ends. */
#include "kernel/biharmonic/bounded_program.h"

#include "base/minmax.h"
#include "math/ldlt.h"

#include <math.h>
#include <string.h>

/* The largest error of values and steps. It is above the rounding errors of systems with a
 * condition number of 1e8, which meshes of 10,000 vertices have. */
static const double ENOUGH = 1e-10;
/* Rounds without progress before single changes: the butterfly of examples/data with 3,000 nodes
 * has up to 20 of them on a good way. After MOST_ROUNDS a program is given up. */
enum { PATIENCE = 100, MOST_ROUNDS = 10000 };
enum side { AT_0 = -1, FREE = 0, AT_1 = 1 };

typedef struct search {
    const iccp_bounded *program;
    double *x;
    int8_t *state;    /* by row */
    uint32_t *number; /* by row: its number among the free rows, or the number of rows */
    uint32_t *order;  /* of the free rows */
    size_t n_free;
    /* The matrix of the free rows */
    size_t *first;
    uint32_t *column;
    double *value, *diagonal;
    double *free, *work; /* values of the free rows */
    double *force;       /* by row: Qx */
} search;

static bool is_free(const search *s, size_t i)
{
    return !s->program->held[i] && s->state[i] == FREE;
}

/* Numbers the free rows and gathers their matrix and right-hand side. */
static void gather(search *s)
{
    const iccp_symmetric *q = s->program->matrix;
    size_t n_entries = 0, n_ordered = 0;
    s->n_free = 0;
    for (size_t i = 0; i < q->n; ++i)
        s->number[i] = (uint32_t)(is_free(s, i) ? s->n_free++ : q->n);
    for (size_t i = 0, k = 0; i < q->n; ++i) {
        if (s->number[i] == q->n)
            continue;
        double force = 0;
        s->first[k] = n_entries;
        for (size_t p = q->first[i]; p < q->first[i + 1]; ++p) {
            const uint32_t j = q->column[p];
            if (s->number[j] < q->n) {
                s->column[n_entries] = s->number[j];
                s->value[n_entries++] = q->value[p];
            } else {
                force -= q->value[p] * s->x[j];
            }
        }
        s->diagonal[k] = q->diagonal[i];
        s->free[k++] = force;
    }
    s->first[s->n_free] = n_entries;
    for (size_t k = 0; k < q->n; ++k)
        if (s->number[s->program->order[k]] < q->n)
            s->order[n_ordered++] = s->number[s->program->order[k]];
}

static icc_status solve_free(search *s, const iccp_env *env)
{
    gather(s);
    if (s->n_free == 0)
        return ICC_OK;
    const iccp_symmetric m = {s->n_free, s->first, s->column, s->value, s->diagonal};
    iccp_ldlt factor;
    icc_status status = iccp_ldlt_analyse_ordered(&factor, &m, s->order, env);
    if (status != ICC_OK)
        return status;
    status = iccp_ldlt_factorise(&factor, &m, env);
    if (status == ICC_OK)
        iccp_ldlt_solve(&factor, 1, s->free, s->work);
    for (size_t i = 0; status == ICC_OK && i < s->program->matrix->n; ++i)
        if (is_free(s, i))
            s->x[i] = s->free[s->number[i]];
    iccp_ldlt_free(&factor);
    return status;
}

static void find_forces(search *s)
{
    const iccp_symmetric *q = s->program->matrix;
    for (size_t i = 0; i < q->n; ++i) {
        double force = q->diagonal[i] * s->x[i];
        for (size_t p = q->first[i]; p < q->first[i + 1]; ++p)
            force += q->value[p] * s->x[q->column[p]];
        s->force[i] = force;
    }
}

/* Returns the state that a row should have. */
static int8_t wanted(const search *s, size_t i)
{
    const double step = -s->force[i] / s->program->matrix->diagonal[i];
    if (s->state[i] == FREE)
        return s->x[i] < -ENOUGH ? AT_0 : s->x[i] > 1 + ENOUGH ? AT_1 : FREE;
    return s->state[i] * step < -ENOUGH ? FREE : s->state[i];
}

/* Changes the state of all wrong rows, or of the last one. Returns the number of wrong rows. */
static size_t change(search *s, bool all)
{
    size_t n = 0;
    for (size_t i = s->program->matrix->n; i-- > 0;) {
        const int8_t state = s->program->held[i] ? s->state[i] : wanted(s, i);
        if (state == s->state[i])
            continue;
        if (all || n == 0)
            s->state[i] = state;
        if (s->state[i] != FREE)
            s->x[i] = s->state[i] == AT_1 ? 1 : 0;
        ++n;
    }
    return n;
}

static size_t count_wrong(const search *s)
{
    size_t n = 0;
    for (size_t i = 0; i < s->program->matrix->n; ++i)
        n += !s->program->held[i] && wanted(s, i) != s->state[i];
    return n;
}

static icc_status run(search *s, const iccp_env *env)
{
    size_t least = SIZE_MAX, patience = PATIENCE;
    for (size_t k = 0; k < MOST_ROUNDS; ++k) {
        const icc_status status = solve_free(s, env);
        if (status != ICC_OK)
            return status;
        find_forces(s);
        const size_t n = count_wrong(s);
        if (n == 0)
            return ICC_OK;
        if (n < least) {
            least = n;
            patience = PATIENCE;
        } else {
            patience -= patience > 0;
        }
        (void)change(s, patience > 0);
    }
    return ICC_ERR_SOLVER;
}

static double clamp(double x)
{
    return iccp_min(iccp_max(x, 0), 1);
}

/* Puts the free values between their bounds, and measures what is left to gain. */
static double finish(search *s)
{
    const iccp_symmetric *q = s->program->matrix;
    double most = 0;
    for (size_t i = 0; i < q->n; ++i)
        if (!s->program->held[i])
            s->x[i] = clamp(s->x[i]);
    find_forces(s);
    for (size_t i = 0; i < q->n; ++i)
        if (!s->program->held[i])
            most = iccp_max(most, fabs(s->x[i] - clamp(s->x[i] - s->force[i] / q->diagonal[i])));
    return most;
}

icc_status iccp_bounded_solve(const iccp_bounded *program, double *x, double *residual,
                              const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const size_t n = program->matrix->n, n_entries = program->matrix->first[n];
    search s = {.program = program, .x = x};
    s.state = iccp_alloc_zero(memory, n, sizeof *s.state);
    s.number = iccp_alloc(memory, n, sizeof *s.number);
    s.order = iccp_alloc(memory, n, sizeof *s.order);
    s.first = iccp_alloc(memory, n + 1, sizeof *s.first);
    s.column = iccp_alloc(memory, n_entries, sizeof *s.column);
    s.value = iccp_alloc(memory, n_entries, sizeof *s.value);
    s.diagonal = iccp_alloc(memory, 4 * n, sizeof *s.diagonal);
    icc_status status = ICC_ERR_MEMORY;
    if (s.state != NULL && s.number != NULL && s.order != NULL && s.first != NULL &&
        s.column != NULL && s.value != NULL && s.diagonal != NULL) {
        s.free = s.diagonal + n;
        s.work = s.free + n;
        s.force = s.work + n;
        status = run(&s, env);
    }
    if (status == ICC_OK)
        *residual = finish(&s);
    void *const arrays[] = {s.state, s.number, s.order, s.first, s.column, s.value, s.diagonal};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; ++i)
        iccp_free(memory, arrays[i]);
    return status;
}
