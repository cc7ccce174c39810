/* Primal-dual active set for Laplace's function under the tree's inequalities. Source: M.
 * Hintermueller, K. Ito, K. Kunisch, The primal-dual active set strategy as a semismooth Newton
 * method, SIAM J. Optim. 13, 2002.
 *
 * An active inequality ties a child to its parent. So each step solves a smaller problem of the
 * same kind (tied.h), and one sweep from the leaves to the root gives the multipliers. All tests
 * are relative to the local value of the function, which spans hundreds of orders of magnitude in
 * long limbs. */
#include "gradient/solver/active_set.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "base/random.h"
#include "gradient/solver/inequalities.h"

#include <math.h>
#include <stdbool.h>

enum {
    MOST_ITERATIONS = 1000,
    PATIENCE = 3,    /* steps without progress before changes become smaller */
    MOST_LEVELS = 60 /* reaches single changes, unless there are 2^60 candidates */
};

/* Progress reports count this many rounds as half of the work. */
static const double TYPICAL_ROUNDS = 8;

/* Slacks and multipliers in units of f up to NOISE are rounding errors. With a factorisation they
 * were at most 3e-14 (700,000 unknowns). */
static const double NOISE = 3e-13;

/* Shares are squared, and a tenth of the exponents is left for the entries of the factor. */
static const double LEAST_SHARE = 1e-120;

typedef struct state {
    const iccp_unknowns *unknowns;
    const iccp_scaled *f;
    double sigma;
    bool *active; /* by unknown: the edge to its parent is active */
    bool *wrong;  /* by unknown: its edge is active with a negative multiplier, or violated */
    size_t n_wrong;
    uint32_t *top; /* ties that follow from `active`: see iccp_ties, like the next two */
    double *share;
    uint32_t *order;
    /* By unknown: multiplier of its edge if that is active, in units of 2^exponent of f at the
     * unknown's top */
    double *multiplier;
    double *work; /* 2 n, including the multipliers: for the residual */
    uint64_t random;
} state;

/* Returns false if the share of an unknown underflows. */
static bool tie(state *s)
{
    double least = 1;
    s->top[0] = 0;
    s->share[0] = 1;
    for (uint32_t k = 1; k < s->unknowns->n; ++k) {
        const uint32_t p = s->unknowns->parent[k];
        s->top[k] = s->active[k] ? s->top[p] : k;
        s->share[k] = s->active[k] ? s->share[p] / s->sigma : 1;
        least = iccp_min(least, s->share[k]);
    }
    return least > LEAST_SHARE;
}

/* (1 + eta) multiplier_k = (sum of the multipliers of k's active children) - (row k of the
 * gradient). */
static void find_multipliers(state *s)
{
    const iccp_unknowns *unknowns = s->unknowns;
    for (size_t k = 0; k < unknowns->n; ++k)
        s->multiplier[k] = 0;
    for (size_t k = unknowns->n; k-- > 1;) {
        if (!s->active[k])
            continue;
        const double row = iccp_laplacian_row(unknowns, s->f, k, s->f->exponent[s->top[k]]);
        s->multiplier[k] = (s->multiplier[k] - row) / s->sigma;
        s->multiplier[unknowns->parent[k]] += s->multiplier[k];
    }
}

/* Returns by how much f_parent >= sigma f_child is violated, in units of f_parent. */
static double violation(const state *s, size_t k)
{
    const uint32_t p = s->unknowns->parent[k];
    return s->sigma * iccp_scaled_get(s->f, k, s->f->exponent[p]) / s->f->fraction[p] - 1;
}

/* Returns by how much a multiplier is negative, in units of f. */
static double pull(const state *s, size_t k)
{
    return -s->multiplier[k] / iccp_scaled_get(s->f, k, s->f->exponent[s->top[k]]);
}

/* Marks the inequalities whose state is wrong. */
static void mark_wrong(state *s)
{
    find_multipliers(s);
    s->n_wrong = 0;
    for (size_t k = 1; k < s->unknowns->n; ++k) {
        const double by = s->active[k] ? pull(s, k) : violation(s, k);
        s->wrong[k] = by > NOISE;
        s->n_wrong += s->wrong[k];
    }
}

/* Changes each wrong inequality with probability 2^-level, and the last one if that chose none.
 *
 * In the variables f_parent - sigma f_child this is a linear complementarity problem with a
 * positive definite matrix. As the level rises, only the last wrong one changes. That is Murty's
 * rule, which reaches the solution from every state: K. Murty, Note on a Bard-type scheme for
 * solving the complementarity problem, Opsearch 11, 1974. */
static void flip_some(state *s, int level)
{
    const uint64_t mask = ((uint64_t)1 << level) - 1;
    size_t n_left = s->n_wrong, n_flipped = 0;
    for (size_t k = 1; n_left > 0; ++k) {
        if (!s->wrong[k])
            continue;
        --n_left;
        if ((iccp_random(&s->random) & mask) != 0 && (n_left > 0 || n_flipped > 0))
            continue;
        s->active[k] = !s->active[k];
        ++n_flipped;
    }
}

/* Begins with the empty set, for which f is the solution. All wrong inequalities change as long as
 * their number falls. After every PATIENCE steps without a new minimum, the share that changes is
 * halved; only a solver that never converges was seen to need that. */
static icc_status iterate(state *s, iccp_tied_solver solve, iccp_solution *info,
                          const iccp_env *env)
{
    const iccp_ties ties = {s->top, s->share, s->order};
    int stalled = 0;
    tie(s);
    mark_wrong(s);
    for (size_t n_rounds = 0, least = s->n_wrong; s->n_wrong > 0;) {
        const iccp_env part = iccp_round(env, n_rounds++, TYPICAL_ROUNDS);
        icc_status status = iccp_progress(&part, "solve", 0);
        const int level = stalled / PATIENCE;
        flip_some(s, level < MOST_LEVELS ? level : MOST_LEVELS);
        if (status == ICC_OK && (!tie(s) || info->n_iterations == MOST_ITERATIONS))
            status = ICC_ERR_SOLVER;
        if (status == ICC_OK)
            status = solve(s->unknowns, &ties, s->f, info, &part);
        if (status != ICC_OK)
            return status;
        ++info->n_iterations;
        mark_wrong(s);
        stalled = s->n_wrong < least ? 0 : stalled + 1;
        least = s->n_wrong < least ? s->n_wrong : least;
    }
    return ICC_OK;
}

/* The values are at most 1, so underflow does not matter here. */
static double residual(const state *s)
{
    const iccp_scaled row = {s->share, NULL};
    for (size_t k = 0; k < s->unknowns->n; ++k)
        s->share[k] = iccp_laplacian_row(s->unknowns, s->f, k, 0);
    return iccp_inequalities_residual(s->unknowns, s->sigma - 1, 0, s->f, &row, s->work);
}

static void sweep_and_report(state *s, iccp_solution *info)
{
    const double start = iccp_seconds();
    info->n_active = 0;
    for (size_t k = 1; k < s->unknowns->n; ++k)
        info->n_active += s->active[k];
    info->residual_before = residual(s);
    iccp_inequalities_sweep(s->unknowns, s->sigma - 1, s->f);
    info->residual = residual(s);
    info->seconds_verify += iccp_seconds() - start;
}

icc_status iccp_active_set_laplace(const iccp_unknowns *unknowns, double eta,
                                   iccp_tied_solver solve, uint32_t *order, const iccp_scaled *f,
                                   iccp_solution *info, const iccp_env *env)
{
    const iccp_memory *m = &env->memory;
    const size_t n = unknowns->n;
    bool *flags = iccp_alloc_zero(m, 2 * n, sizeof *flags);
    uint32_t *top = iccp_alloc(m, n, sizeof *top);
    double *numbers = iccp_alloc(m, 3 * n, sizeof *numbers);
    icc_status status = ICC_ERR_MEMORY;
    if (flags != NULL && top != NULL && numbers != NULL) {
        state s = {.unknowns = unknowns,
                   .f = f,
                   .sigma = 1 + eta,
                   .active = flags,
                   .wrong = flags + n,
                   .top = top,
                   .order = order,
                   .share = numbers,
                   .multiplier = numbers + n,
                   .work = numbers + n,
                   .random = 1};
        info->n_violated = iccp_inequalities_violated(unknowns, eta, f);
        info->n_iterations = 0;
        status = iterate(&s, solve, info, env);
        if (status == ICC_OK)
            sweep_and_report(&s, info);
    }
    iccp_free(m, flags);
    iccp_free(m, top);
    iccp_free(m, numbers);
    return status;
}
