/* Solves the tied problem by conjugate gradients, in shells. The error that an iteration leaves is
 * relative to the largest value. So a solution is accepted only where it exceeds CUT times that.
 * The remaining unknowns are solved for again, with the accepted ones as given values, in units of
 * the largest of these. The equations are the same, so the shells fit together to the accuracy of
 * each.
 *
 * A shell need not include all remaining unknowns. Suppose that it ends where the solution has
 * fallen to v, with 0 assumed beyond. Then a value of w has an error of about (v / w)^2 of itself
 * (sinh(D - s) / sinh(D) in place of exp(-s)). Only values that came from the shell itself could
 * flow back into it, because unknowns next to known ones always belong to the shell. */
#include "base/clock.h"
#include "base/minmax.h"
#include "base/sort.h"
#include "gradient/solver/tied.h"
#include "gradient/solver/tied_cg.h"

#include <string.h>

/* Accepts values above CUT of the largest and 1 / CUT times those where the shell ends. All CUTs
 * from 1e-5 to 1e-8 leave residuals below 1e-9 of each value. Lower ones need fewer shells. */
static const double CUT = 1e-7;

/* CUT squared. Values below this share of the largest do not help to guess the size of a shell, and
 * at the border of a shell they should be no larger. */
static const double NEGLIGIBLE = 1e-14;

/* Each shell is solved to a tenth of CUT, so that unknowns next to an accepted one are good,
 * too. */
static const iccp_mg_goal GOAL = {.relative = 1e-10, .componentwise = 1e-9, .floor = 1e-8};

enum { LEAST_GROWTH = 512 };

enum { LEFT = 0, IN_SHELL = 1, KNOWN = 2 };

typedef struct shells {
    const iccp_unknowns *unknowns;
    const iccp_ties *ties;
    const iccp_scaled *f;
    iccp_solution *info;
    const iccp_env *env;
    uint32_t *order;   /* n unknowns, sorted by top: members follow their top */
    uint32_t *cluster; /* n + 1: where the cluster of each top begins in `order` */
    uint8_t *state;    /* n: LEFT, IN_SHELL, KNOWN */
    uint32_t *unknown; /* n: unknowns of the shell; members follow their top */
    size_t n;          /* number of these unknowns */
    size_t n_left;     /* unknowns that are LEFT */
    size_t growth;     /* unknowns to add to those that the last shell leaves */
    bool first;
} shells;

typedef struct shell {
    uint32_t *position; /* by unknown: its place among the entries of the finest level */
    iccp_tie *tie;
    size_t n_tied;
    iccp_multigrid mg;
    double *x, *r, *q;
    int32_t exponent; /* x is in units of 2^exponent */
} shell;

static void add_cluster(shells *s, uint32_t top)
{
    for (uint32_t i = s->cluster[top]; i < s->cluster[top + 1]; ++i) {
        s->n_left -= s->state[s->order[i]] == LEFT && !s->first;
        s->state[s->order[i]] = IN_SHELL;
        s->unknown[s->n++] = s->order[i];
    }
}

static icc_status report(const shells *s, size_t i)
{
    return i % ICCP_VERTICES_PER_REPORT == 0 ? iccp_progress(s->env, "solve", 0) : ICC_OK;
}

/* Makes the first shell. */
static icc_status add_all(shells *s)
{
    icc_status status = ICC_OK;
    for (uint32_t k = 0; k < s->unknowns->n && status == ICC_OK; ++k) {
        if (s->ties->top[k] == k)
            add_cluster(s, k);
        status = report(s, k);
    }
    return status;
}

static const uint32_t *neighbours(const shells *s, uint32_t unknown)
{
    return s->unknowns->neighbour + unknown * (size_t)s->unknowns->n_neighbours;
}

static bool has_neighbour(const shells *s, uint32_t unknown, uint8_t state)
{
    for (int32_t d = 0; d < s->unknowns->n_neighbours; ++d) {
        const uint32_t j = neighbours(s, unknown)[d];
        if (j != ICCP_NONE && s->state[j] == state)
            return true;
    }
    return false;
}

/* Adds unknowns in the order of their distance from those that are in the shell. */
static void grow(shells *s)
{
    const size_t least = s->n + s->growth;
    for (size_t i = 0; i < s->n && s->n < least; ++i)
        for (int32_t d = 0; d < s->unknowns->n_neighbours; ++d) {
            const uint32_t j = neighbours(s, s->unknown[i])[d];
            if (j != ICCP_NONE && s->state[j] == LEFT)
                add_cluster(s, s->ties->top[j]);
        }
}

/* ------------------------------------------------------------------ one shell */

/* The largest known value next to the shell determines the unit. */
static void find_exponent(const shells *s, shell *h)
{
    h->exponent = s->first ? 0 : ICCP_ZERO_EXPONENT;
    for (size_t i = 0; i < s->n && !s->first; ++i)
        for (int32_t d = 0; d < s->unknowns->n_neighbours; ++d) {
            const uint32_t j = neighbours(s, s->unknown[i])[d];
            if (j != ICCP_NONE && s->state[j] == KNOWN && s->f->exponent[j] > h->exponent)
                h->exponent = s->f->exponent[j];
        }
}

/* r = P' of the contribution of known values. In the first shell nothing is known. There it is a
 * unit load at the root, and the solution is scaled afterwards. */
static void load(const shells *s, shell *h)
{
    size_t top = 0;
    if (s->first)
        h->r[h->position[0]] = 1;
    for (size_t i = 0; i < s->n && !s->first; ++i) {
        const uint32_t unknown = s->unknown[i];
        double sum = 0;
        if (s->ties->top[unknown] == unknown)
            top = h->position[i];
        for (int32_t d = 0; d < s->unknowns->n_neighbours; ++d) {
            const uint32_t j = neighbours(s, unknown)[d];
            if (j != ICCP_NONE && s->state[j] == KNOWN)
                sum += iccp_scaled_get(s->f, j, h->exponent);
        }
        h->r[top] += s->ties->share[unknown] * sum;
    }
}

/* Lists the ties and fills in the guess. */
static icc_status place(const shells *s, shell *h)
{
    icc_status status = ICC_OK;
    size_t top = 0;
    for (size_t i = 0; i < s->n && status == ICC_OK; ++i) {
        const uint32_t unknown = s->unknown[i];
        const size_t at = h->position[i];
        if (s->ties->top[unknown] == unknown) {
            top = at;
            h->x[at] = iccp_scaled_get(s->f, unknown, h->exponent);
        } else
            h->tie[h->n_tied++] = (iccp_tie){at, top, s->ties->share[unknown]};
        status = report(s, i);
    }
    return status;
}

/* Scales the guess, for which q is P'LP x, so that its energy is least. Makes r its residual, and
 * returns the size of the load. */
static double begin_with_guess(shell *h)
{
    const size_t n = h->mg.level[0].n_entries;
    for (size_t i = 0; i < h->n_tied; ++i)
        h->x[h->tie[i].member] = 0;
    const double size = sqrt(iccp_mg_dot(n, h->r, h->r)), xb = iccp_mg_dot(n, h->x, h->r);
    const double energy = iccp_mg_dot(n, h->x, h->q), scale = xb / energy;
    const bool usable = isfinite(scale) && energy > 0;
    for (size_t i = 0; i < n; ++i) {
        h->x[i] = usable ? scale * h->x[i] : 0;
        h->r[i] -= usable ? scale * h->q[i] : 0;
    }
    return size;
}

static icc_status solve(shells *s, shell *h)
{
    iccp_tied_apply(&h->mg.level[0], h->n_tied, h->tie, h->x, h->q);
    icc_status status = report(s, 0);
    if (status != ICC_OK)
        return status;
    const double size = begin_with_guess(h);
    iccp_free(&s->env->memory, h->q);
    h->q = NULL;
    status = report(s, 0);
    if (status != ICC_OK)
        return status;
    return h->n_tied > 0 ? iccp_tied_cg(&h->mg, h->n_tied, h->tie, h->x, h->r, size, &GOAL,
                                        &s->info->n_inner, s->env)
                         : iccp_mg_cg(&h->mg, h->x, h->r, size, &GOAL, &s->info->n_inner, s->env);
}

static bool allocate(const shells *s, shell *h)
{
    const iccp_memory *m = &s->env->memory;
    const size_t n = h->mg.level[0].n_entries;
    size_t n_tied = 0;
    for (size_t i = 0; i < s->n; ++i)
        n_tied += s->ties->top[s->unknown[i]] != s->unknown[i];
    h->tie = iccp_alloc(m, n_tied, sizeof *h->tie);
    h->x = iccp_alloc_zero(m, n, sizeof *h->x);
    h->r = iccp_alloc_zero(m, n, sizeof *h->r);
    h->q = iccp_alloc_zero(m, n, sizeof *h->q);
    return h->tie != NULL && h->x != NULL && h->r != NULL && h->q != NULL;
}

/* Makes the multigrid for the shell's vertices alone, with the rest as the outside. Known values
 * enter through the load, and the remaining unknowns count as 0. All allocations stay in h for
 * free_shell(), also on failure. */
static icc_status solve_shell(shells *s, shell *h)
{
    const double start = iccp_seconds();
    h->position = iccp_alloc(&s->env->memory, s->n, sizeof *h->position);
    if (h->position == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < s->n; ++i)
        h->position[i] = s->unknowns->vertex[s->unknown[i]];
    icc_status status = iccp_multigrid_create(&h->mg, s->unknowns->tree->grid, s->n, h->position,
                                              h->position, s->env);
    if (status == ICC_OK && !allocate(s, h))
        status = ICC_ERR_MEMORY;
    if (status != ICC_OK)
        return status;
    find_exponent(s, h);
    status = place(s, h);
    if (status != ICC_OK)
        return status;
    load(s, h);
    const double middle = iccp_seconds();
    s->info->seconds_setup += middle - start;
    status = solve(s, h);
    s->info->seconds_solve += iccp_seconds() - middle;
    return status;
}

static void free_shell(const shells *s, shell *h)
{
    const iccp_memory *m = &s->env->memory;
    iccp_multigrid_free(&h->mg);
    iccp_free(m, h->position);
    iccp_free(m, h->tie);
    iccp_free(m, h->x);
    iccp_free(m, h->r);
    iccp_free(m, h->q);
}

/* ----------------------------------------------------------------- accepting */

typedef struct extent {
    double peak;        /* largest value */
    double border;      /* largest value next to unknowns that are left out */
    size_t significant; /* number of unknowns with a value that is not negligible */
} extent;

/* Also spreads x to the members. */
static extent measure(const shells *s, shell *h)
{
    extent e = {0, 0, 0};
    const size_t n = h->mg.level[0].n_entries;
    for (size_t i = 0; i < h->n_tied; ++i)
        h->x[h->tie[i].member] = h->tie[i].share * h->x[h->tie[i].top];
    for (size_t i = 0; i < n; ++i)
        e.peak = h->x[i] > e.peak ? h->x[i] : e.peak;
    for (size_t i = 0; i < n; ++i)
        e.significant += h->x[i] > NEGLIGIBLE * e.peak;
    for (size_t i = 0; i < s->n && s->n_left > 0; ++i) {
        const double x = h->x[h->position[i]];
        if (x > e.border && has_neighbour(s, s->unknown[i], LEFT))
            e.border = x;
    }
    return e;
}

/* Uses the normalised value, because shares may be tiny. */
static void share_top(const shells *s, uint32_t unknown)
{
    const uint32_t top = s->ties->top[unknown];
    iccp_scaled_set(s->f, unknown, s->ties->share[unknown] * s->f->fraction[top],
                    s->f->exponent[top]);
}

/* Accepts the unknowns whose tops exceed the limit. */
static icc_status accept_unknowns(shells *s, const shell *h, double limit, double one)
{
    icc_status status = ICC_OK;
    bool accepted = false;
    for (size_t i = 0; i < s->n && status == ICC_OK; ++i) {
        const uint32_t unknown = s->unknown[i];
        const double x = h->x[h->position[i]];
        if (s->ties->top[unknown] == unknown)
            accepted = x > limit;
        status = report(s, i);
        if (!accepted)
            continue;
        s->state[unknown] = KNOWN;
        if (s->ties->top[unknown] == unknown)
            iccp_scaled_set(s->f, unknown, x / one, h->exponent);
        else
            share_top(s, unknown);
    }
    return status;
}

/* Returns true if the next shell keeps the cluster that begins at unknown[i]: it is worth it, or
 * required. */
static bool is_kept(const shells *s, const shell *h, size_t i, size_t end, double negligible)
{
    if (s->state[s->unknown[i]] == KNOWN)
        return false;
    bool kept = h->x[h->position[i]] > negligible;
    for (; i < end && !kept; ++i)
        kept = has_neighbour(s, s->unknown[i], KNOWN);
    return kept;
}

/* Collects the unknowns that the next shell keeps. Their values are the guess there. */
static void keep_unknowns(shells *s, const shell *h, double negligible, double one)
{
    size_t n = 0;
    for (size_t i = 0, end = 0; i < s->n; i = end) {
        const uint32_t top = s->unknown[i];
        end = i + s->cluster[top + 1] - s->cluster[top];
        const bool kept = is_kept(s, h, i, end, negligible);
        const bool guessed = kept && h->x[h->position[i]] > 0;
        for (; i < end; ++i) {
            const uint32_t unknown = s->unknown[i];
            if (guessed)
                iccp_scaled_set(s->f, unknown, h->x[h->position[i]] / one, h->exponent);
            if (kept)
                s->unknown[n++] = unknown;
            else if (s->state[unknown] == IN_SHELL)
                s->state[unknown] = LEFT;
            s->n_left += s->state[unknown] == LEFT;
        }
    }
    s->n = n;
}

/* A shell that ends too early is not worth its work, and one that goes too far costs more. */
static void adapt_growth(shells *s, const extent *e)
{
    const double wanted = NEGLIGIBLE * e->peak;
    if (s->first)
        s->growth = e->significant / 2;
    else if (e->border > wanted)
        s->growth += s->growth / 2;
    else if (e->border < 1e-3 * wanted)
        s->growth -= s->growth / 8;
    s->growth = s->growth > LEAST_GROWTH ? s->growth : LEAST_GROWTH;
}

/* Accepts the good part of a solved shell, and prepares the next one. */
static icc_status advance(shells *s, shell *h)
{
    const extent e = measure(s, h);
    const double limit = iccp_max(CUT * e.peak, 1 / CUT * e.border);
    const double one = s->first ? h->x[h->position[0]] : 1;
    if (!(e.peak > 0 && one > 0 && isfinite(one)))
        return ICC_ERR_SOLVER;
    icc_status status = report(s, 0);
    if (status == ICC_OK)
        status = accept_unknowns(s, h, limit, one);
    if (status != ICC_OK)
        return status;
    keep_unknowns(s, h, NEGLIGIBLE * e.peak, one);
    adapt_growth(s, &e);
    s->first = false;
    grow(s);
    return ICC_OK;
}

static icc_status next_shell(shells *s)
{
    shell h = {0};
    icc_status status = solve_shell(s, &h);
    if (status == ICC_OK)
        status = advance(s, &h);
    free_shell(s, &h);
    return status;
}

icc_status iccp_tied_iterative(const iccp_unknowns *unknowns, const iccp_ties *ties,
                               const iccp_scaled *f, iccp_solution *info, const iccp_env *env)
{
    const iccp_memory *m = &env->memory;
    shells s = {
        .unknowns = unknowns, .ties = ties, .f = f, .info = info, .env = env, .first = true};
    s.order = iccp_alloc(m, unknowns->n, sizeof *s.order);
    s.cluster = iccp_alloc_zero(m, unknowns->n + 1, sizeof *s.cluster);
    s.state = iccp_alloc_zero(m, unknowns->n, sizeof *s.state);
    s.unknown = iccp_alloc(m, unknowns->n, sizeof *s.unknown);
    icc_status status = ICC_ERR_MEMORY;
    if (s.order != NULL && s.cluster != NULL && s.state != NULL && s.unknown != NULL) {
        iccp_list_groups(s.order, s.cluster, unknowns->n, ties->top, unknowns->n, 1);
        status = add_all(&s);
    }
    while (status == ICC_OK && s.n > 0) {
        status = iccp_progress(env, "solve", 1 - (double)(s.n + s.n_left) / (double)unknowns->n);
        if (status == ICC_OK)
            status = next_shell(&s);
    }
    iccp_free(m, s.order);
    iccp_free(m, s.cluster);
    iccp_free(m, s.state);
    iccp_free(m, s.unknown);
    return status;
}
