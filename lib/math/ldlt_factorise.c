/* Left-looking supernodal factorisation. Source: E. Ng, B. Peyton, Block sparse Cholesky algorithms
 * on advanced uniprocessor computers, SIAM J. Sci. Comput. 14, 1993, with L D L^T in place of L
 * L^T.
 *
 * A panel first gets the entries of the matrix. Then it receives, tile by tile, the product of each
 * earlier panel that has rows among its columns. Finally it is factorised by itself. On several
 * threads, subtrees of the elimination tree come first. Panels that leave a subtree join the lists
 * of later panels at the same place as without threads, so the bits are the same. */
#include "math/ldlt.h"
#include "math/panel.h"

#include "base/budget.h"
#include "base/compiler.h"

#include <string.h>

#define NONE ICCP_NO_PARENT
#define STRIP ((size_t)ICCP_STRIP)

/* Overhead of a panel in multiplications: about a microsecond. */
static const double PER_PANEL = 2000;

/* A smaller factorisation is finished before threads start, which takes some 30 us. */
static const double LEAST_FOR_THREADS = 5e4;

/* Shares of the whole labour. Subtrees of the share SMALL run first, many at the same time, then
 * larger ones that contain them. Two threads need fewer subtrees. */
static const double SMALL = 1.0 / 16, LARGE = 1.0 / 3, SMALL_OF_TWO = 1.0 / 12,
                    LARGE_OF_TWO = 1.0 / 2.2;

/* A list of panels in order of arrival. */
typedef struct queue {
    uint32_t first, last; /* or NONE */
} queue;

/* Workspace of one factorisation, or of one task's part of it. Each finished panel waits in the
 * list of the next panel that needs it. If that panel belongs to another task, it waits in the
 * queue `leaving`. */
typedef struct factorisation {
    iccp_ldlt *l;
    const iccp_symmetric *matrix;
    int8_t *sign; /* in elimination order, or NULL */
    iccp_dense dense;
    uint32_t *waiting; /* first panel that waits for each panel, or NONE */
    uint32_t *next;    /* the panel that waits behind each panel */
    size_t *done;      /* first row of each panel that has not been used yet */
    uint32_t end;      /* one past the task's last panel */
    queue leaving;
    iccp_labour labour;
    uint32_t *local; /* n: place of each row of the factor in the current panel */
    uint32_t *place; /* place of each row of the updating panel in the updated one */
    double *packed;  /* see iccp_panel_pack() */
} factorisation;

static void find_local(const factorisation *f, uint32_t s)
{
    const iccp_supernodes *nodes = &f->l->nodes;
    const uint32_t first = nodes->column[s], columns = nodes->column[s + 1] - first;
    const uint32_t *row = nodes->row + nodes->first_row[s];
    for (uint32_t k = 0; k < columns; ++k)
        f->local[first + k] = k;
    for (uint32_t i = 0; i < iccp_supernodes_below(nodes, s); ++i)
        f->local[row[i]] = columns + i;
}

/* Rows of the matrix are scattered in memory. So this prefetches the row that is needed AHEAD rows
 * later. */
static void fetch_ahead(const factorisation *f, size_t k)
{
    enum { AHEAD = 8, PER_LINE = 8 };
    const iccp_symmetric *m = f->matrix;
    const uint32_t *order = f->l->order + k;
    if (k + 2 * AHEAD >= m->n)
        return;
    const size_t begin = m->first[order[AHEAD]], end = m->first[order[AHEAD] + 1];
    ICCP_PREFETCH(m->first + order[2 * AHEAD]);
    ICCP_PREFETCH(m->diagonal + order[AHEAD]);
    for (size_t q = begin; q < end; q += PER_LINE) {
        ICCP_PREFETCH(m->column + q);
        ICCP_PREFETCH(m->value + q);
    }
}

/* Copies the entries of the matrix into the panel. */
static void load_entries(const factorisation *f, uint32_t s, const iccp_panel *p)
{
    const iccp_ldlt *l = f->l;
    const iccp_symmetric *m = f->matrix;
    const uint32_t first = l->nodes.column[s];
    memset(p->value, 0, (l->nodes.first_value[s + 1] - l->nodes.first_value[s]) * sizeof *p->value);
    for (uint32_t k = 0; k < p->columns; ++k) {
        const uint32_t row = l->order[first + k];
        double *column = p->value + STRIP * k;
        fetch_ahead(f, first + k);
        column[iccp_panel_row(p, k)] = m->diagonal[row];
        for (size_t q = m->first[row]; q < m->first[row + 1]; ++q) {
            const uint32_t i = l->position[m->column[q]];
            if (i > first + k)
                column[iccp_panel_row(p, f->local[i])] += m->value[q];
        }
    }
}

/* The update of a later panel by panel `from`. Rows [begin, end) of `from` are columns of the later
 * panel. */
typedef struct update {
    const factorisation *f;
    iccp_panel from;
    size_t begin, end;
    double *value; /* values of the later panel */
    size_t columns;
    size_t block, block_end; /* the part of these rows that is packed */
} update;

/* Subtracts one strip of a tile, in the columns from row j on. Most strips are also four
 * consecutive rows in the later panel. */
static void scatter(const update *u, const double *tile, size_t strip, size_t j, size_t width)
{
    const size_t start = STRIP * strip, stride = STRIP * u->columns;
    const uint32_t *place = u->f->place + start;
    const uint32_t *column = u->f->place + j;
    if (start >= u->begin && start + STRIP <= u->from.rows && place[STRIP - 1] - place[0] == 3) {
        u->f->dense.subtract(u->value + place[0] / STRIP * stride, place[0] % STRIP, stride, column,
                             width, tile);
        return;
    }
    for (size_t i = start < u->begin ? u->begin - start : 0; i < STRIP && start + i < u->from.rows;
         ++i) {
        double *row = u->value + place[i] / STRIP * stride + place[i] % STRIP;
        for (size_t c = 0; c < width; ++c)
            row[STRIP * column[c]] -= tile[STRIP * c + i];
    }
}

/* Handles several strips at a time, so that `multiply` uses each packed entry as often. Skips tiles
 * above the diagonal. */
static icc_status update_strips(void *argument, size_t strip, size_t strips)
{
    const update *u = argument;
    const size_t depth = u->from.columns, stride = STRIP * depth;
    for (size_t n; strip < strips; strip += n) {
        const double *b = u->f->packed;
        n = iccp_strips_at_once(strips - strip);
        for (size_t j = u->block; j < u->block_end && j < STRIP * (strip + n); j += ICCP_TILE) {
            const size_t left = u->block_end - j, width = iccp_panel_width(left);
            double tile[ICCP_STRIPS * ICCP_TILE * ICCP_STRIP];
            u->f->dense.multiply(tile, n, width, u->from.value + strip * stride, stride, b, depth);
            for (size_t t = 0; t < n; ++t)
                scatter(u, tile + t * ICCP_TILE * STRIP, strip + t, j, left < width ? left : width);
            b += width * depth;
        }
    }
    return ICC_OK;
}

static icc_status apply_update(factorisation *f, update *u)
{
    const size_t n_strips = (u->from.rows + STRIP - 1) / STRIP, depth = u->from.columns;
    icc_status status = ICC_OK;
    for (u->block = u->begin; status == ICC_OK && u->block < u->end; u->block = u->block_end) {
        u->block_end = u->end - u->block < ICCP_AT_ONCE ? u->end : u->block + ICCP_AT_ONCE;
        iccp_panel_pack(f->packed, &u->from, u->block, u->block_end, 0, depth);
        status = iccp_labour_strips(&f->labour, u->block / STRIP, n_strips,
                                    (double)(STRIP * (u->block_end - u->block)) * (double)depth,
                                    update_strips, u);
    }
    return status;
}

static void leave(factorisation *f, uint32_t from)
{
    f->next[from] = NONE;
    if (f->leaving.last == NONE)
        f->leaving.first = from;
    else
        f->next[f->leaving.last] = from;
    f->leaving.last = from;
}

/* Puts panel `from` into the list of the panel that owns its row number `done`. */
static void enlist(factorisation *f, uint32_t from, size_t done)
{
    const iccp_supernodes *nodes = &f->l->nodes;
    const size_t columns = iccp_supernodes_columns(nodes, from);
    if (done == columns + iccp_supernodes_below(nodes, from))
        return;
    const uint32_t to = nodes->owner[nodes->row[nodes->first_row[from] + done - columns]];
    f->done[from] = done;
    if (to >= f->end) {
        leave(f, from);
    } else {
        f->next[from] = f->waiting[to];
        f->waiting[to] = from;
    }
}

static icc_status update_from(factorisation *f, uint32_t from, uint32_t to)
{
    const iccp_supernodes *nodes = &f->l->nodes;
    const iccp_panel panel = iccp_panel_of(nodes, from, f->l->value, f->l->pivot);
    const iccp_panel target = iccp_panel_of(nodes, to, f->l->value, f->l->pivot);
    const uint32_t *below = nodes->row + nodes->first_row[from];
    const size_t begin = f->done[from];
    size_t end = begin;
    while (end < panel.rows && below[end - panel.columns] < nodes->column[to + 1])
        ++end;
    for (size_t i = begin; i < panel.rows; ++i)
        f->place[i] = f->local[below[i - panel.columns]];
    update u = {f, panel, begin, end, target.value, target.columns, 0, 0};
    const icc_status status = apply_update(f, &u);
    enlist(f, from, end);
    return status;
}

/* Multiplications, including those by zeros, of a panel's own factorisation and its updates of
 * others. */
static double labour_of(const iccp_supernodes *nodes, size_t s)
{
    const double columns = (double)iccp_supernodes_columns(nodes, s);
    const double below = (double)iccp_supernodes_below(nodes, s);
    return PER_PANEL + columns * (columns * columns / 6 + below * (columns + below) / 2);
}

/* When panel s begins, waiting[s] lists exactly the finished panels with rows among the columns of
 * s. Each of them then moves to the panel of its next row. */
static icc_status factorise_panel(factorisation *f, uint32_t s)
{
    const iccp_supernodes *nodes = &f->l->nodes;
    const iccp_panel panel = iccp_panel_of(nodes, s, f->l->value, f->l->pivot);
    const int8_t *sign = f->sign == NULL ? NULL : f->sign + nodes->column[s];
    icc_status status = ICC_OK;
    find_local(f, s);
    load_entries(f, s, &panel);
    for (uint32_t from = f->waiting[s], next; status == ICC_OK && from != NONE; from = next) {
        next = f->next[from];
        status = update_from(f, from, s);
    }
    if (status == ICC_OK)
        status = iccp_panel_factorise(&panel, sign, &f->dense, f->packed, &f->labour);
    if (status == ICC_OK)
        status = iccp_labour_add(&f->labour, PER_PANEL);
    if (status == ICC_OK)
        enlist(f, s, panel.columns);
    return status;
}

/* ---- subtrees ---- */

/* Subtrees that run at the same time, each on one thread. */
typedef struct forest {
    const factorisation *whole;
    const struct forest *inner; /* smaller subtrees inside these, which are done already; or NULL */
    const iccp_subtrees *subtrees;
    queue *leaving; /* panels that leave each run */
} forest;

static icc_status make_space(factorisation *f)
{
    const iccp_supernodes *nodes = &f->l->nodes;
    const iccp_memory *memory = &f->labour.env->memory;
    f->local = iccp_alloc(memory, f->l->n, sizeof *f->local);
    f->place = iccp_alloc(memory, nodes->most_rows, sizeof *f->place);
    f->packed = iccp_alloc(memory, nodes->most_columns, ICCP_AT_ONCE * sizeof *f->packed);
    return f->local != NULL && f->place != NULL && f->packed != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

static void free_space(const factorisation *f)
{
    const iccp_memory *memory = &f->labour.env->memory;
    iccp_free(memory, f->local);
    iccp_free(memory, f->place);
    iccp_free(memory, f->packed);
}

/* Passes the panels that left a run to the panels above it, in order of arrival. */
static void send_on(factorisation *f, const queue *leaving)
{
    for (uint32_t from = leaving->first, next; from != NONE; from = next) {
        next = f->next[from];
        enlist(f, from, f->done[from]);
    }
}

/* Left-looking: panel s is finished before panel s + 1 begins. Runs that are done already are
 * skipped. */
static icc_status factorise_range(factorisation *f, const forest *done, uint32_t begin,
                                  uint32_t end)
{
    const size_t n = done != NULL ? done->subtrees->n : 0;
    const iccp_subtrees_run *run = done != NULL ? done->subtrees->run : NULL;
    icc_status status = ICC_OK;
    size_t k = 0;
    while (k < n && run[k].begin < begin)
        ++k;
    for (uint32_t s = begin; status == ICC_OK && s < end;) {
        if (k < n && s == run[k].begin) {
            send_on(f, &done->leaving[k]);
            s = run[k++].end;
        } else {
            status = factorise_panel(f, s++);
        }
    }
    return status;
}

/* Factorises one run on one thread. */
static icc_status factorise_run(void *argument, size_t begin, size_t end)
{
    const forest *t = argument;
    const iccp_subtrees_run *run = &t->subtrees->run[begin];
    factorisation f = *t->whole;
    (void)end;
    f.end = run->end;
    f.labour.env = &f.labour.quiet;
    f.labour.quiet.threads = 1;
    f.labour.quiet.parallel_for = NULL;
    icc_status status = make_space(&f);
    if (status == ICC_OK)
        status = factorise_range(&f, t->inner, run->begin, run->end);
    free_space(&f);
    t->leaving[begin] = f.leaving;
    return status;
}

/* Factorises all runs on all threads. Progress goes from share `from` of the labour to share
 * `to`. */
static icc_status factorise_runs(forest *t, double from, double to)
{
    const iccp_env *env = t->whole->labour.env;
    const iccp_env part = iccp_part(env, NULL, from, to);
    t->leaving = iccp_alloc(&env->memory, t->subtrees->n, sizeof *t->leaving);
    return t->leaving != NULL ? iccp_for_chunks(&part, "solve", t->subtrees->n, 1, factorise_run, t)
                              : ICC_ERR_MEMORY;
}

/* Finds the subtrees once, for all factorisations. */
static icc_status find_subtrees(iccp_ldlt *l, const iccp_env *env)
{
    iccp_env own = *env;
    own.memory = l->memory;
    const double large = env->threads == 2 ? LARGE_OF_TWO : LARGE;
    const double small = env->threads == 2 ? SMALL_OF_TWO : SMALL;
    icc_status status = ICC_OK;
    if (l->large.run == NULL)
        status = iccp_subtrees_create(&l->large, &l->nodes, large, NULL, labour_of, &own);
    if (status == ICC_OK && l->small.run == NULL)
        status = iccp_subtrees_create(&l->small, &l->nodes, small, &l->large, labour_of, &own);
    return status;
}

/* ---- all of it ---- */

/* Factorises many small subtrees, then a few large ones, then the panels above them. */
static icc_status factorise_at_once(factorisation *f)
{
    iccp_ldlt *l = f->l;
    const iccp_env *env = f->labour.env;
    forest small = {.whole = f, .subtrees = &l->small};
    forest large = {.whole = f, .subtrees = &l->large, .inner = &small};
    icc_status status = find_subtrees(l, env);
    const double first = l->small.labour / f->labour.all, second = l->large.labour / f->labour.all;
    if (status == ICC_OK)
        status = factorise_runs(&small, 0, first);
    if (status == ICC_OK)
        status = factorise_runs(&large, first, second);
    if (status == ICC_OK)
        status = iccp_labour_add(&f->labour, l->large.labour);
    if (status == ICC_OK)
        status = factorise_range(f, &large, 0, (uint32_t)l->nodes.n);
    iccp_free(&env->memory, small.leaving);
    iccp_free(&env->memory, large.leaving);
    return status;
}

static icc_status factorise_panels(factorisation *f)
{
    const iccp_supernodes *nodes = &f->l->nodes;
    const iccp_env *env = f->labour.env;
    for (uint32_t s = 0; s < nodes->n; ++s) {
        f->labour.all += labour_of(nodes, s);
        f->waiting[s] = NONE;
    }
    icc_status status = iccp_progress(env, "solve", 0);
    if (status == ICC_OK)
        status = iccp_budget_work(env, f->labour.all);
    if (status != ICC_OK)
        return status;
    return iccp_has_threads(env) && f->labour.all > LEAST_FOR_THREADS
               ? factorise_at_once(f)
               : factorise_range(f, NULL, 0, (uint32_t)nodes->n);
}

static icc_status make_room(iccp_ldlt *l)
{
    if (l->value == NULL)
        l->value = iccp_alloc(&l->memory, l->nodes.first_value[l->nodes.n], sizeof *l->value);
    if (l->pivot == NULL)
        l->pivot = iccp_alloc(&l->memory, l->n, sizeof *l->pivot);
    return l->value != NULL && l->pivot != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

icc_status iccp_ldlt_factorise_signed(iccp_ldlt *factor, const iccp_symmetric *matrix,
                                      const int8_t *sign, const iccp_env *env)
{
    const iccp_supernodes *nodes = &factor->nodes;
    const iccp_memory *memory = &env->memory;
    factorisation f = {.l = factor,
                       .matrix = matrix,
                       .dense = iccp_dense_choose(),
                       .end = (uint32_t)nodes->n,
                       .leaving = {NONE, NONE},
                       .labour = {.env = env, .quiet = *env}};
    icc_status status = make_room(factor);
    f.labour.quiet.progress = NULL;
    f.waiting = iccp_alloc(memory, nodes->n, 2 * sizeof *f.waiting);
    f.done = iccp_alloc(memory, nodes->n, sizeof *f.done);
    if (sign != NULL)
        f.sign = iccp_alloc(memory, factor->n, sizeof *f.sign);
    if (make_space(&f) != ICC_OK || f.waiting == NULL || f.done == NULL ||
        (sign != NULL && f.sign == NULL))
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        f.next = f.waiting + nodes->n;
        for (size_t k = 0; sign != NULL && k < factor->n; ++k)
            f.sign[k] = sign[factor->order[k]];
        status = factorise_panels(&f);
    }
    free_space(&f);
    iccp_free(memory, f.waiting);
    iccp_free(memory, f.done);
    iccp_free(memory, f.sign);
    return status;
}

icc_status iccp_ldlt_factorise(iccp_ldlt *factor, const iccp_symmetric *matrix, const iccp_env *env)
{
    return iccp_ldlt_factorise_signed(factor, matrix, NULL, env);
}
