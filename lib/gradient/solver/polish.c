/* Primal-dual active set: M. Hintermueller, K. Ito, K. Kunisch, The primal-dual active set strategy
 * as a semismooth Newton method, SIAM J. Optim. 13, 2002.
 *
 * A'A is no M-matrix, so nothing guarantees that the iteration converges. It nearly always does.
 * From the empty set it advances about one generation per step where f becomes as small as the
 * bounds. From the last iterates of an interior point method it takes a few steps.
 *
 * Active edges tie children to parents. A cluster with active leaves is held: its values are the
 * highest that one of these leaves requires. The other leaves are then above their bounds, usually
 * by no more than eta times the bound, which is negligible. If it is more than `enough`, they
 * become inactive. */
#include "gradient/solver/polish.h"

#include "base/clock.h"
#include "base/minmax.h"
#include "base/random.h"
#include "gradient/solver/inequalities.h"

#include <math.h>
#include <string.h>

/* Corrections with neither a smaller residual nor fewer changes that are made in full. */
enum { TRUST = 3 };

/* Slacks and multipliers are wrong below minus this share of `enough`. With a share of 1, a contact
 * moves by one unknown per step where the function is tiny. With 0.01, rounding errors become
 * active. */
static const double WRONG = 0.1;

enum { LIFTED = 1, RISES = 2, STAYS = 4, TIED = 8, FREED = 16 };

typedef struct state {
    const iccp_qp *qp;
    size_t n;
    double enough, tolerance;
    uint8_t *active; /* by inequality */
    uint8_t *open;   /* by unknown: active edges lead down from here to an active leaf */
    /* LIFTED: such a leaf takes over a negative multiplier of the unknown's edge. RISES: the
     * cluster of this top pulls at its leaves. STAYS: but not here. TIED, FREED: the unknown's edge
     * has just become active, or inactive. */
    uint8_t *mark;
    uint32_t *top;        /* by unknown: the top of its cluster */
    uint32_t *variable;   /* variable of its cluster, or ICCP_NONE if it is held */
    double *share;        /* share of the value of the top */
    double *held;         /* by top: its value if held, or 0 */
    double *f, *gradient; /* by unknown */
    double *sum;          /* sum of the multipliers of the children's edges */
    double *work;
    double *room;  /* memory of the arrays of doubles */
    bool by_rows;  /* see tie_rows() */
    bool hesitant; /* only every other change is made, at random */
    uint64_t random;
} state;

/* Decides whether to make a change. Making all changes may cycle: it does on a serpentine of 100
 * cells and on a letter C of 200. */
static bool decide(state *s)
{
    if (!s->hesitant)
        return true;
    return iccp_random(&s->random) >> 63;
}

static uint8_t *leaf_active(const state *s, size_t j)
{
    return &s->active[s->n - 1 + j];
}

static void find_clusters(state *s)
{
    const uint32_t *parent = s->qp->unknowns->parent;
    for (uint32_t k = 0; k < s->n; ++k) {
        const bool tied = k > 0 && s->active[k - 1];
        s->top[k] = tied ? s->top[parent[k]] : k;
        s->share[k] = tied ? s->share[parent[k]] / s->qp->sigma : 1;
        s->held[k] = k == 0;
    }
}

/* The root holds its cluster, whatever the leaves require. */
static void hold_clusters(state *s)
{
    const iccp_qp *p = s->qp;
    for (size_t j = 0; j < p->n_leaves; ++j) {
        const uint32_t k = p->leaf_unknown[j], t = s->top[k];
        if (*leaf_active(s, j) && t > 0)
            s->held[t] = iccp_max(s->held[t], p->leaf / s->share[k]);
    }
    for (size_t j = 0; j < p->n_leaves; ++j) {
        const uint32_t k = p->leaf_unknown[j];
        if (s->held[s->top[k]] * s->share[k] > p->leaf + s->enough)
            *leaf_active(s, j) = 0;
    }
}

static iccp_reduction reduce(state *s)
{
    size_t n_variables = 0;
    find_clusters(s);
    hold_clusters(s);
    for (uint32_t k = 0; k < s->n; ++k) {
        const uint32_t t = s->top[k];
        if (t != k)
            s->variable[k] = s->variable[t];
        else
            s->variable[k] = s->held[k] > 0 ? ICCP_NONE : (uint32_t)n_variables++;
        if (s->variable[k] == ICCP_NONE)
            s->f[k] = s->held[t] * s->share[k];
    }
    return (iccp_reduction){n_variables, s->variable, s->share};
}

static icc_status solve(state *s, double *residual, iccp_solution *info, const iccp_env *env)
{
    const iccp_qp *p = s->qp;
    const iccp_reduction reduction = reduce(s);
    const icc_status status = iccp_energy_minimise(&p->a, &reduction, NULL, s->f, info, env);
    if (status != ICC_OK)
        return status;
    const double start = iccp_seconds();
    const iccp_scaled f = {s->f, NULL}, gradient = {s->gradient, NULL};
    iccp_energy_gradient(&p->a, s->f, s->work, s->gradient);
    *residual =
        iccp_inequalities_residual(p->unknowns, p->sigma - 1, p->leaf, &f, &gradient, s->work);
    info->seconds_verify += iccp_seconds() - start;
    return ICC_OK;
}

/* Returns how many leaves fell below their bound. They become active. */
static size_t correct_leaves(state *s)
{
    const iccp_qp *p = s->qp;
    size_t n_wrong = 0;
    memset(s->open, 0, s->n);
    for (size_t j = 0; j < p->n_leaves; ++j) {
        const uint32_t k = p->leaf_unknown[j];
        s->open[k] = *leaf_active(s, j);
        if (!*leaf_active(s, j) && s->f[k] < p->leaf - s->tolerance) {
            *leaf_active(s, j) = decide(s);
            ++n_wrong;
        }
    }
    return n_wrong;
}

/* Makes violated edges active, and edges with a negative multiplier inactive. Returns how many. The
 * gradient gives the multipliers in a sweep from the leaves to the root. Leaves of a held cluster
 * have multipliers of their own, as many as necessary to keep the edges above them from becoming
 * negative. The rest at the top must not be positive; otherwise the cluster rises. */
static size_t correct_edges(state *s)
{
    const iccp_qp *p = s->qp;
    size_t n_wrong = 0;
    memset(s->sum, 0, s->n * sizeof *s->sum);
    memset(s->mark, 0, s->n);
    for (size_t k = s->n; k-- > 1;) {
        const uint32_t q = p->unknowns->parent[k];
        double multiplier = (s->sum[k] - s->gradient[k]) / p->sigma;
        uint8_t *active = &s->active[k - 1];
        if (!*active) {
            const bool rises = s->open[k] && multiplier > s->tolerance;
            const bool violated = s->f[q] - p->sigma * s->f[k] < -s->tolerance;
            s->mark[k] |= rises && decide(s) ? RISES : 0;
            *active = violated && decide(s);
            s->mark[k] |= *active ? TIED : 0;
            n_wrong += (size_t)rises + violated;
            continue;
        }
        if (s->open[k] && multiplier < 0) {
            s->mark[k] |= LIFTED;
            multiplier = 0;
        }
        s->open[q] |= s->open[k];
        s->sum[q] += multiplier;
        if (multiplier < -s->tolerance) {
            *active = !decide(s);
            s->mark[k] |= *active ? 0 : FREED;
            ++n_wrong;
        }
    }
    return n_wrong;
}

/* Returns true if an edge follows an adjacent one that has just become active. */
static bool follows(const state *s, uint32_t k, uint32_t next)
{
    const iccp_qp *p = s->qp;
    return k > 0 && (s->mark[next] & TIED) && !s->active[k - 1] && !(s->mark[k] & FREED) &&
           s->f[p->unknowns->parent[k]] - p->sigma * s->f[k] <= s->tolerance;
}

static void tie(state *s, uint32_t k)
{
    s->active[k - 1] = 1;
    s->mark[k] |= TIED;
}

/* Where the function is almost 0, edges that should be active are violated by less than the
 * tolerance. They would become active one after another along a row, one per step. So edges whose
 * slack is no larger follow at once, down the tree and up. If the set is far from the right one,
 * this is as likely to mislead. */
static void tie_rows(state *s)
{
    const uint32_t *parent = s->qp->unknowns->parent;
    for (uint32_t k = 1; k < s->n; ++k)
        if (follows(s, k, parent[k]))
            tie(s, k);
    for (uint32_t k = (uint32_t)s->n; k-- > 1;)
        if (follows(s, parent[k], k))
            tie(s, parent[k]);
}

/* The lifted parts of a rising cluster stay, each by itself and in one piece, whatever is lifted
 * further down in it. Edges untied there would be violated at once, and tied again one by one. The
 * leaves of the rest become inactive. */
static void let_rise(state *s)
{
    const iccp_qp *p = s->qp;
    for (uint32_t k = 1; k < s->n; ++k) {
        const uint32_t t = s->top[k];
        if (t == k || !(s->mark[t] & RISES))
            continue;
        if (s->mark[p->unknowns->parent[k]] & STAYS) {
            s->mark[k] |= STAYS;
        } else if (s->mark[k] & LIFTED) {
            s->mark[k] |= STAYS;
            s->active[k - 1] = 0;
        }
    }
    for (size_t j = 0; j < p->n_leaves; ++j) {
        const uint32_t k = p->leaf_unknown[j];
        if ((s->mark[s->top[k]] & RISES) && !(s->mark[k] & STAYS))
            *leaf_active(s, j) = 0;
    }
}

/* Keeps the best candidate, whatever becomes of the set. A step costs patience if it finds neither
 * a smaller residual nor fewer wrong inequalities than ever before. When some patience is used up,
 * only every other change is made, which breaks cycles. */
static icc_status iterate(state *s, iccp_candidate *candidate, iccp_solution *info,
                          const iccp_env *env)
{
    int patience = ICCP_QP_PATIENCE;
    size_t fewest = SIZE_MAX;
    while (patience > 0) {
        double residual;
        const icc_status status = solve(s, &residual, info, env);
        if (status == ICC_ERR_SOLVER)
            return ICC_OK; /* the best candidate so far may suffice */
        if (status != ICC_OK)
            return status;
        ++info->n_iterations;
        --patience;
        if (residual < candidate->residual) {
            memcpy(candidate->f, s->f, s->n * sizeof *s->f);
            candidate->residual = residual;
            patience = ICCP_QP_PATIENCE;
        }
        s->hesitant = patience <= ICCP_QP_PATIENCE - TRUST;
        const size_t n_wrong = correct_leaves(s) + correct_edges(s);
        if (s->by_rows)
            tie_rows(s);
        let_rise(s);
        if (residual <= s->enough || n_wrong == 0)
            break;
        if (n_wrong < fewest) {
            fewest = n_wrong;
            patience = ICCP_QP_PATIENCE;
        }
    }
    return ICC_OK;
}

icc_status iccp_polish(const iccp_qp *qp, uint8_t *active, bool by_rows, double enough,
                       iccp_candidate *candidate, iccp_solution *info, const iccp_env *env)
{
    const size_t n = qp->unknowns->n, n_work = qp->a.n_rows + n; /* at least 2 n */
    state s = {.qp = qp, .n = n, .active = active, .by_rows = by_rows};
    s.enough = enough;
    s.tolerance = WRONG * enough;
    s.top = iccp_alloc(&env->memory, n, 2 * sizeof *s.top);
    s.open = iccp_alloc(&env->memory, n, 2 * sizeof *s.open);
    s.room = iccp_alloc(&env->memory, 5 * n + n_work, sizeof *s.room);
    icc_status status = ICC_ERR_MEMORY;
    if (s.top != NULL && s.open != NULL && s.room != NULL) {
        s.variable = s.top + n;
        s.mark = s.open + n;
        s.share = s.room;
        s.held = s.room + n;
        s.f = s.room + 2 * n;
        s.gradient = s.room + 3 * n;
        s.sum = s.room + 4 * n;
        s.work = s.room + 5 * n;
        status = iterate(&s, candidate, info, env);
    }
    iccp_free(&env->memory, s.top);
    iccp_free(&env->memory, s.open);
    iccp_free(&env->memory, s.room);
    return status;
}
