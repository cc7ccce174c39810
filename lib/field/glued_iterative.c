/* The glued problem by conjugate gradients, in shells. What an iteration leaves as an error is relative to the
 * largest value. So a solution is accepted only where it exceeds CUT times that; the rows left are solved for
 * again, with the accepted ones as given values, in units of the largest of these. The equations are
 * the same, so that the shells fit together to the accuracy of each.
 *
 * A shell need not reach to the end of what is left: if it ends where the solution has fallen to v, with 0
 * assumed beyond, a value of w is wrong by about (v / w)^2 of itself (sinh(D - s) / sinh(D) in place of
 * exp(-s)). Rows are taken in the order of the tree, which reaches near rows first. */
#include "base/clock.h"
#include "field/glued.h"
#include "field/glued_cg.h"

#include <string.h>

/* Accepted: values above CUT of the largest and TRUNCATION times those where the shell ends. Of 1e-5 ..
 * 1e-8, all leave residuals below 1e-9 of each value; the lower, the fewer shells. */
static const double CUT = 1e-7, TRUNCATION = 1e7;

/* Values below this share of the largest are no help in guessing how large a shell should be. */
static const double NEGLIGIBLE = 1e-14;

/* Each shell is solved to this; a tenth of CUT, so that rows next to an accepted one are good, too. */
static const iccp_mg_goal GOAL = {.relative = 1e-10, .componentwise = 1e-9, .floor = 1e-8};

enum { LEAST_SHELL = 1024 };

enum { LEFT = 0, IN_SHELL = 1, KNOWN = 2 };

typedef struct shells {
    const iccp_rows *rows;
    const iccp_gluing *gluing;
    const iccp_scaled *f;
    icc_field_info *info;
    const iccp_env *env;
    uint32_t *order; /* n rows, by their tops: members behind their top */
    uint8_t *state;  /* n: LEFT, IN_SHELL, KNOWN */
    size_t begin, end, size; /* the shell: rows order[begin] .. order[end - 1]; their wanted number */
} shells;

typedef struct shell {
    uint32_t *vertex;   /* grid vertices of its rows; later their positions */
    iccp_glue *glue;
    size_t n_glued;
    iccp_multigrid mg;
    double *x, *r, *q;
    int32_t exponent;   /* x is in units of 2^exponent */
} shell;

/* Rows by their tops, stable: a counting sort. */
static icc_status sort_rows(shells *s)
{
    const size_t n = s->rows->n;
    uint32_t *first = iccp_alloc_zero(&s->env->memory, n + 1, sizeof *first);
    if (first == NULL)
        return ICC_ERR_MEMORY;
    for (size_t k = 0; k < n; ++k)
        ++first[s->gluing->top[k] + 1];
    for (size_t k = 0; k < n; ++k)
        first[k + 1] += first[k];
    for (uint32_t k = 0; k < n; ++k)
        s->order[first[s->gluing->top[k]]++] = k;
    iccp_free(&s->env->memory, first);
    return ICC_OK;
}

static bool is_last(const shells *s, size_t i)
{
    return i + 1 == s->rows->n || s->gluing->top[s->order[i + 1]] != s->gluing->top[s->order[i]];
}

static void choose_rows(shells *s)
{
    const size_t left = s->rows->n - s->begin;
    s->end = s->begin + (s->size < left ? s->size : left);
    while (!is_last(s, s->end - 1))
        ++s->end;
    for (size_t i = s->begin; i < s->end; ++i)
        s->state[s->order[i]] = IN_SHELL;
}

/* ------------------------------------------------------------------ one shell */

static const uint32_t *neighbours(const shells *s, uint32_t row)
{
    return s->rows->neighbour + row * (size_t)s->rows->n_neighbours;
}

/* The largest known value next to the shell decides on the unit. */
static void find_exponent(const shells *s, shell *h)
{
    h->exponent = s->begin == 0 ? 0 : ICCP_ZERO_EXPONENT;
    for (size_t i = s->begin; i < s->end && s->begin > 0; ++i)
        for (int32_t d = 0; d < s->rows->n_neighbours; ++d) {
            const uint32_t j = neighbours(s, s->order[i])[d];
            if (j != ICCP_NONE && s->state[j] == KNOWN && s->f->exponent[j] > h->exponent)
                h->exponent = s->f->exponent[j];
        }
}

/* r = P' of what the known values contribute. In the first shell nothing is known; there it is a unit load
 * at the root, and the solution is scaled afterwards. */
static void load(const shells *s, shell *h)
{
    size_t top = 0;
    if (s->begin == 0)
        h->r[h->vertex[0]] = 1;
    for (size_t i = s->begin; i < s->end && s->begin > 0; ++i) {
        const uint32_t row = s->order[i];
        double sum = 0;
        if (s->gluing->top[row] == row)
            top = h->vertex[i - s->begin];
        for (int32_t d = 0; d < s->rows->n_neighbours; ++d) {
            const uint32_t j = neighbours(s, row)[d];
            if (j != ICCP_NONE && s->state[j] == KNOWN)
                sum += iccp_scaled_get(s->f, j, h->exponent);
        }
        h->r[top] += s->gluing->share[row] * sum;
    }
}

/* Replaces vertices by positions, lists what is glued and fills in the guess. */
static void place(const shells *s, shell *h)
{
    const iccp_mg_level *level = &h->mg.level[0];
    size_t top = 0;
    for (size_t i = s->begin; i < s->end; ++i) {
        const uint32_t row = s->order[i];
        uint32_t x;
        const size_t r = iccp_mg_row_of(level, s->rows->tree->grid, h->vertex[i - s->begin], &x);
        const size_t at = iccp_mg_position(level, r, x);
        h->vertex[i - s->begin] = (uint32_t)at;
        if (s->gluing->top[row] == row) {
            top = at;
            h->x[at] = iccp_scaled_get(s->f, row, h->exponent);
        } else
            h->glue[h->n_glued++] = (iccp_glue){at, top, s->gluing->share[row]};
    }
}

/* Scales the guess so that its energy is least, and makes r its residual; the size of the load. */
static double begin_with_guess(shell *h)
{
    const iccp_mg_level *level = &h->mg.level[0];
    const size_t n = level->n_entries;
    iccp_glued_apply(level, h->n_glued, h->glue, h->x, h->q);
    for (size_t i = 0; i < h->n_glued; ++i)
        h->x[h->glue[i].member] = 0;
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
    const double size = begin_with_guess(h);
    iccp_free(&s->env->memory, h->q);
    h->q = NULL;
    return h->n_glued > 0 ? iccp_glued_cg(&h->mg, h->n_glued, h->glue, h->x, h->r, size, &GOAL,
                                          &s->info->n_inner, s->env)
                          : iccp_mg_cg(&h->mg, h->x, h->r, size, &GOAL, &s->info->n_inner, s->env);
}

static bool allocate(const shells *s, shell *h)
{
    const iccp_memory *m = &s->env->memory;
    const size_t n = h->mg.level[0].n_entries;
    size_t n_glued = 0;
    for (size_t i = s->begin; i < s->end; ++i)
        n_glued += s->gluing->top[s->order[i]] != s->order[i];
    h->glue = iccp_alloc(m, n_glued, sizeof *h->glue);
    h->x = iccp_alloc_zero(m, n, sizeof *h->x);
    h->r = iccp_alloc_zero(m, n, sizeof *h->r);
    h->q = iccp_alloc_zero(m, n, sizeof *h->q);
    return h->glue != NULL && h->x != NULL && h->r != NULL && h->q != NULL;
}

static icc_status solve_shell(shells *s, shell *h)
{
    const double start = iccp_seconds();
    const size_t n = s->end - s->begin;
    h->vertex = iccp_alloc(&s->env->memory, n, sizeof *h->vertex);
    if (h->vertex == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < n; ++i)
        h->vertex[i] = s->rows->vertex[s->order[s->begin + i]];
    icc_status status = iccp_multigrid_create(&h->mg, s->rows->tree->grid, n, h->vertex, s->env);
    if (status == ICC_OK && !allocate(s, h))
        status = ICC_ERR_MEMORY;
    if (status != ICC_OK)
        return status;
    find_exponent(s, h);
    place(s, h);
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
    iccp_free(m, h->vertex);
    iccp_free(m, h->glue);
    iccp_free(m, h->x);
    iccp_free(m, h->r);
    iccp_free(m, h->q);
}

/* ----------------------------------------------------------------- accepting */

typedef struct extent {
    double peak;        /* the largest value */
    double rim;         /* the largest next to rows that are left out */
    size_t significant; /* rows with a value that is not negligible */
} extent;

static bool is_on_rim(const shells *s, uint32_t row)
{
    for (int32_t d = 0; d < s->rows->n_neighbours; ++d) {
        const uint32_t j = neighbours(s, row)[d];
        if (j != ICCP_NONE && s->state[j] == LEFT)
            return true;
    }
    return false;
}

/* Spreads x to the members on the way. */
static extent measure(const shells *s, shell *h)
{
    extent e = {0, 0, 0};
    for (size_t i = 0; i < h->n_glued; ++i)
        h->x[h->glue[i].member] = h->glue[i].share * h->x[h->glue[i].top];
    for (size_t i = s->begin; i < s->end; ++i)
        e.peak = fmax(e.peak, h->x[h->vertex[i - s->begin]]);
    for (size_t i = s->begin; i < s->end; ++i) {
        const double x = h->x[h->vertex[i - s->begin]];
        e.significant += x > NEGLIGIBLE * e.peak;
        if (s->end < s->rows->n && x > e.rim && is_on_rim(s, s->order[i]))
            e.rim = x;
    }
    return e;
}

/* Takes over the rows whose tops exceed the limit; the others move up to the end of the shell. */
static size_t accept_rows(shells *s, const shell *h, double limit, double unit)
{
    size_t to = s->end, top = s->end;
    for (size_t i = s->end; i-- > s->begin;) {
        /* Backwards: the top of a row is the first of its cluster. */
        if (is_last(s, i) || i + 1 == s->end)
            for (top = i; s->gluing->top[s->order[top]] != s->order[top];)
                --top;
        const uint32_t row = s->order[i];
        const bool accepted = h->x[h->vertex[top - s->begin]] > limit;
        s->state[row] = accepted ? KNOWN : LEFT;
        if (accepted)
            iccp_scaled_set(s->f, row, unit * h->x[h->vertex[i - s->begin]], h->exponent);
        else
            s->order[--to] = row;
    }
    const size_t n_accepted = to - s->begin;
    s->begin = to;
    return n_accepted;
}

/* A shell that ends too early is worth less than its work, one that goes too far costs more. */
static void adapt_size(shells *s, const extent *e, bool first)
{
    const double wanted = CUT / TRUNCATION * e->peak;
    if (first)
        s->size = e->significant;
    else if (e->rim > wanted)
        s->size += s->size / 2;
    else if (e->rim < 1e-3 * wanted)
        s->size -= s->size / 8;
    s->size = s->size > LEAST_SHELL ? s->size : LEAST_SHELL;
}

static icc_status next_shell(shells *s)
{
    shell h = {0};
    const bool first = s->begin == 0;
    choose_rows(s);
    icc_status status = solve_shell(s, &h);
    if (status == ICC_OK) {
        const extent e = measure(s, &h);
        const double limit = fmax(CUT * e.peak, TRUNCATION * e.rim);
        const double unit = first ? 1 / h.x[h.vertex[0]] : 1;
        if (!(e.peak > 0) || !isfinite(unit))
            status = ICC_ERR_SOLVER;
        else {
            accept_rows(s, &h, limit, unit);
            adapt_size(s, &e, first);
        }
    }
    free_shell(s, &h);
    return status;
}

icc_status iccp_glued_iterative(const iccp_rows *rows, const iccp_gluing *gluing,
                                const iccp_scaled *f, icc_field_info *info, const iccp_env *env)
{
    shells s = {.rows = rows, .gluing = gluing, .f = f, .info = info, .env = env, .size = rows->n};
    s.order = iccp_alloc(&env->memory, rows->n, sizeof *s.order);
    s.state = iccp_alloc_zero(&env->memory, rows->n, sizeof *s.state);
    icc_status status = s.order != NULL && s.state != NULL ? sort_rows(&s) : ICC_ERR_MEMORY;
    while (status == ICC_OK && s.begin < rows->n) {
        status = iccp_progress(env, "multigrid", (double)s.begin / (double)rows->n);
        if (status == ICC_OK)
            status = next_shell(&s);
    }
    iccp_free(&env->memory, s.order);
    iccp_free(&env->memory, s.state);
    return status;
}
