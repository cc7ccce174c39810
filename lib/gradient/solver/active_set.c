/* Primal-dual active set: M. Hintermueller, K. Ito, K. Kunisch, The primal-dual active set strategy
 * as a semismooth Newton method, SIAM J. Optim. 13, 2002. An active inequality ties a child to its
 * parent, so that each step solves a smaller problem of the same kind (tied.h), and one sweep from
 * the leaves to the root gives the multipliers. All tests are relative to the function where they
 * are made: it spans hundreds of orders of magnitude in long limbs. */
#include "gradient/solver/active_set.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "base/random.h"
#include "gradient/solver/inequalities.h"

#include <math.h>
#include <stdbool.h>

enum {
    MOST_ITERATIONS = 1000,
    PATIENCE = 3,    /* steps without progress before smaller ones are taken */
    MOST_LEVELS = 60 /* single changes, unless there are 2^60 candidates */
};

/* Half of the rounds, as far as progress goes. */
static const double TYPICAL_ROUNDS = 8;

/* Slacks and multipliers in units of f are rounding errors up to the first: with a factorisation
 * they were 3e-14 at most (700,000 unknowns). Up to the second they are within what an iterative
 * solver can do. */
static const double NOISE = 3e-13, ACCEPTABLE = 1e-9;

/* Shares are squared, and a tenth of the exponents is left for the entries of the factor. */
static const double LEAST_SHARE = 1e-120;

typedef struct state {
    const iccp_unknowns *unknowns;
    const iccp_scaled *f;
    double sigma;
    bool *active; /* per unknown: the edge to its parent */
    bool *wrong;  /* per unknown: its edge is active with a negative multiplier, or violated */
    size_t n_wrong;
    double worst;  /* the largest multiplier or violation of these */
    uint32_t *top; /* ties by `active`: see iccp_ties, as for the next two */
    double *share;
    uint32_t *order;
    double *multiplier; /* per unknown: of its edge if that is active, in units of 2^exponent of f
                           at the unknown's top */
    double *work;       /* 2 n, the multipliers among them: for the residual */
    uint64_t random;
} state;

/* False when the share of an unknown underflows. */
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

/* (1 + eta) multiplier_k = sum of those of k's active children - row k of the gradient. */
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

/* By how much f_parent >= sigma f_child fails, in units of f_parent. */
static double violation(const state *s, size_t k)
{
    const uint32_t p = s->unknowns->parent[k];
    return s->sigma * iccp_scaled_get(s->f, k, s->f->exponent[p]) / s->f->fraction[p] - 1;
}

/* By how much a multiplier is negative, in units of f. */
static double pull(const state *s, size_t k)
{
    return -s->multiplier[k] / iccp_scaled_get(s->f, k, s->f->exponent[s->top[k]]);
}

/* Marks the inequalities that are on the wrong side. */
static void mark_wrong(state *s)
{
    find_multipliers(s);
    s->n_wrong = 0;
    s->worst = 0;
    for (size_t k = 1; k < s->unknowns->n; ++k) {
        const double by = s->active[k] ? pull(s, k) : violation(s, k);
        s->wrong[k] = by > NOISE;
        s->n_wrong += s->wrong[k];
        s->worst = iccp_max(s->worst, by);
    }
}

/* Changes each of the wrong ones with probability 2^-level, and the last of them if that was none.
 * In the variables f_parent - sigma f_child this is a linear complementarity problem with a
 * positive definite matrix. To change the last alone, to which this comes as the level rises, is
 * Murty's rule, which reaches the solution from every state: K. Murty, Note on a Bard-type scheme
 * for solving the complementarity problem, Opsearch 11, 1974. */
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

/* Begins with the empty set, for which f is the solution. All wrong inequalities are flipped as
 * long as their number falls; every PATIENCE steps without a new minimum the share that is flipped
 * is halved. What is then still wrong by no more than an iterative solver's errors is accepted. */
static icc_status iterate(state *s, iccp_tied_solver solve, icc_function_info *info,
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
        if (stalled >= PATIENCE && s->worst <= ACCEPTABLE)
            break;
        least = s->n_wrong < least ? s->n_wrong : least;
    }
    return ICC_OK;
}

/* The values are at most 1, so that what underflows does not matter here. */
static double residual(const state *s)
{
    const iccp_scaled row = {s->share, NULL};
    for (size_t k = 0; k < s->unknowns->n; ++k)
        s->share[k] = iccp_laplacian_row(s->unknowns, s->f, k, 0);
    return iccp_inequalities_residual(s->unknowns, s->sigma - 1, 0, s->f, &row, s->work);
}

static void sweep_and_report(state *s, icc_function_info *info)
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
                                   icc_function_info *info, const iccp_env *env)
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
