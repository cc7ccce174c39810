/* Triangular solves with a supernodal factor (see ldlt_factorise.c), strip by strip. For a strip of
 * rows, one product covers the columns before its own. The few entries beside the diagonal
 * follow. */
#include "base/compiler.h"
#include "base/threads.h"
#include "math/ldlt.h"
#include "math/panel.h"

#include <stdbool.h>
#include <string.h>

#define STRIP ((size_t)ICCP_STRIP)

/* Right-hand sides that lie next to each other in the workspace: entry i of column s is value[i *
 * width + s]. One pass over a panel serves a whole group. */
typedef struct group {
    double *value;
    size_t width;
} group;

enum { MOST_COLUMNS = ICCP_LDLT_FORMS };

/* Doubles of a cache line, and how many bytes ahead memory is prefetched. */
enum { LINE = 8, AHEAD = 8192 };

/* The rows of a panel that receive its contributions. NULL on the way back means all. */
typedef struct range {
    size_t begin, end;
} range;

/* Smaller factors are solved before other threads start. */
enum { FEW_ENTRIES = 1 << 14 };

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

/* Address of the entries for row i of a panel. */
static double *entries(const group *x, const iccp_panel *p, uint32_t first, const uint32_t *below,
                       size_t i, size_t width)
{
    return x->value + (i < p->columns ? first + i : below[i - p->columns]) * width;
}

/* Panels are contiguous in memory, so the next page is prefetched in time. */
static ICCP_INLINE void fetch(const double *strip, size_t n, intptr_t ahead)
{
    const uintptr_t there = (uintptr_t)strip + (uintptr_t)ahead;
    for (size_t k = 0; k < n; k += LINE)
        ICCP_PREFETCH((const double *)(there + k * sizeof *strip));
}

/* Two strips at a time below the square. */
static ICCP_INLINE void forward(const group *x, const iccp_panel *p, uint32_t first,
                                const uint32_t *below, const range *rows, size_t width,
                                const iccp_dense *dense)
{
    const size_t start = rows->begin / STRIP * STRIP, stride = STRIP * p->columns;
    const double *own = x->value + first * width, *strip = p->value + start * p->columns;
    for (size_t i = start, n; i < rows->end; i += STRIP * n, strip += stride * n) {
        const size_t depth = least(i, p->columns);
        double sum[2 * ICCP_TILE * ICCP_STRIP];
        n = i >= p->columns && i + STRIP < rows->end ? 2 : 1;
        fetch(strip, n * stride, AHEAD);
        dense->multiply(sum, n, width, strip, stride, own, depth);
        for (size_t r = i < rows->begin ? rows->begin - i : 0; r < least(STRIP * n, rows->end - i);
             ++r) {
            double *row = entries(x, p, first, below, i + r, width);
            double *sums = sum + r / STRIP * STRIP * ICCP_TILE + r % STRIP;
            for (size_t k = depth; k < least(i + r, p->columns); ++k)
                for (size_t s = 0; s < width; ++s)
                    sums[STRIP * s] += strip[STRIP * k + r] * own[k * width + s];
            for (size_t s = 0; s < width; ++s)
                row[s] -= sums[STRIP * s];
        }
    }
}

/* x = L^-T D^-1 x for one panel, the mirror image of forward(). It goes through the strips from
 * below, and each adds to the columns on its left. Within the strip on the diagonal, the last row
 * comes first. */
static ICCP_INLINE void backward(const group *x, const iccp_panel *p, uint32_t first,
                                 const uint32_t *below, size_t width, const iccp_dense *dense)
{
    double *own = x->value + first * width;
    for (size_t k = 0; k < p->columns * width; ++k)
        own[k] /= p->pivot[k / width];
    for (size_t i = (p->rows + STRIP - 1) / STRIP * STRIP; i > 0;) {
        i -= STRIP;
        const double *strip = p->value + i * p->columns;
        const size_t depth = least(i, p->columns);
        fetch(strip, STRIP * p->columns, -AHEAD);
        double y[ICCP_STRIP * MOST_COLUMNS];
        for (size_t s = 0; s < STRIP * width; ++s)
            y[s] = 0;
        for (size_t r = least(STRIP, p->rows - i); r-- > 0;) {
            const double *row = entries(x, p, first, below, i + r, width);
            for (size_t s = 0; s < width; ++s) {
                y[r * width + s] = row[s];
                for (size_t k = depth; k < least(i + r, p->columns); ++k)
                    own[k * width + s] -= strip[STRIP * k + r] * row[s];
            }
        }
        if (depth > 0)
            dense->spread(own, width, strip, y, depth);
    }
}

/* With a constant width the loops over columns are unrolled. */
static void pass(const iccp_ldlt *factor, size_t s, const group *x, const range *rows,
                 const iccp_dense *dense)
{
    const iccp_supernodes *nodes = &factor->nodes;
    const iccp_panel panel = iccp_panel_of(nodes, s, factor->value, factor->pivot);
    const uint32_t first = nodes->column[s], *below = nodes->row + nodes->first_row[s];
    if (x->width == MOST_COLUMNS && rows != NULL)
        forward(x, &panel, first, below, rows, MOST_COLUMNS, dense);
    else if (x->width == MOST_COLUMNS)
        backward(x, &panel, first, below, MOST_COLUMNS, dense);
    else if (rows != NULL)
        forward(x, &panel, first, below, rows, 1, dense);
    else
        backward(x, &panel, first, below, 1, dense);
}

/* Returns the group that begins with column `done`: as wide as possible, or one column alone. */
static group group_at(const iccp_ldlt *factor, size_t n_rhs, size_t done, double *work)
{
    return (group){work + factor->n * done, n_rhs - done < MOST_COLUMNS ? 1 : MOST_COLUMNS};
}

/* A system to solve, and the subtrees that run at the same time, if any. */
typedef struct solution {
    iccp_dense dense;
    const iccp_ldlt *factor;
    const iccp_subtrees *subtrees;
    const uint8_t *needed; /* by panel; NULL: all panels are needed */
    size_t n_rhs;
    double *work;
} solution;

/* Applies a panel to all groups while it is in the cache. */
static void pass_all(const solution *x, size_t s, const range *rows)
{
    for (size_t done = 0; done < x->n_rhs;) {
        const group g = group_at(x->factor, x->n_rhs, done, x->work);
        pass(x->factor, s, &g, rows, &x->dense);
        done += g.width;
    }
}

static size_t rows_of(const solution *x, size_t s)
{
    const iccp_supernodes *nodes = &x->factor->nodes;
    return iccp_supernodes_columns(nodes, s) + iccp_supernodes_below(nodes, s);
}

/* Returns the first row of a panel that lies outside its own run of subtrees. */
static size_t first_outside(const solution *x, size_t s, const iccp_subtrees_run *run)
{
    const iccp_supernodes *nodes = &x->factor->nodes;
    const uint32_t *row = nodes->row + nodes->first_row[s], end = nodes->column[run->end];
    size_t low = 0, high = iccp_supernodes_below(nodes, s);
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (row[middle] < end)
            low = middle + 1;
        else
            high = middle;
    }
    return iccp_supernodes_columns(nodes, s) + low;
}

/* Applies each subtree to its own rows. */
static icc_status go_forward(void *argument, size_t begin, size_t end)
{
    const solution *x = argument;
    for (size_t k = begin; k < end; ++k) {
        const iccp_subtrees_run *run = &x->subtrees->run[k];
        for (size_t s = run->begin; s < run->end; ++s)
            pass_all(x, s, &(range){0, first_outside(x, s, run)});
    }
    return ICC_OK;
}

static icc_status go_back(void *argument, size_t begin, size_t end)
{
    const solution *x = argument;
    for (size_t k = begin; k < end; ++k)
        for (size_t s = x->subtrees->run[k].end; s-- > x->subtrees->run[k].begin;)
            pass_all(x, s, NULL);
    return ICC_OK;
}

/* Solves with subtrees on several threads. Each row receives its contributions in the order of the
 * panels. Forward, subtrees first update their own rows and then the rows above them. Backward,
 * subtrees come last. */
static void solve_by_subtrees(const solution *x, const iccp_env *env)
{
    const iccp_subtrees *t = x->subtrees;
    const size_t n_panels = x->factor->nodes.n;
    const iccp_env quiet = iccp_quiet(env);
    (void)iccp_for_chunks(&quiet, "solve", t->n, 1, go_forward, (void *)x);
    for (size_t s = 0, k = 0; s < n_panels; ++s) {
        while (k < t->n && t->run[k].end <= s)
            ++k;
        const bool is_inside = k < t->n && s >= t->run[k].begin;
        pass_all(x, s, &(range){is_inside ? first_outside(x, s, &t->run[k]) : 0, rows_of(x, s)});
    }
    for (size_t s = n_panels, k = t->n; s-- > 0;) {
        while (k > 0 && t->run[k - 1].begin > s)
            --k;
        if (k == 0 || s >= t->run[k - 1].end)
            pass_all(x, s, NULL);
    }
    (void)iccp_for_chunks(&quiet, "solve", t->n, 1, go_back, (void *)x);
}

static void solve_in_turn(const solution *x)
{
    const size_t n_panels = x->factor->nodes.n;
    for (size_t s = 0; s < n_panels; ++s)
        if (x->needed == NULL || x->needed[s])
            pass_all(x, s, &(range){0, rows_of(x, s)});
    for (size_t s = n_panels; s-- > 0;)
        if (x->needed == NULL || x->needed[s])
            pass_all(x, s, NULL);
}

/* Returns the first column, from k on, of a needed panel. `end` is where the run of needed columns
 * ends. */
static size_t next_needed(const solution *x, size_t k, size_t *end)
{
    const iccp_supernodes *nodes = &x->factor->nodes;
    *end = x->factor->n;
    if (x->needed == NULL || k == x->factor->n)
        return k;
    size_t s = nodes->owner[k];
    while (s < nodes->n && !x->needed[s])
        ++s;
    const size_t begin = s < nodes->n && nodes->column[s] > k ? nodes->column[s] : k;
    if (s == nodes->n)
        return x->factor->n;
    while (s < nodes->n && x->needed[s])
        ++s;
    *end = nodes->column[s];
    return begin;
}

/* Copies the right-hand sides from the caller's order to groups of columns in the factor's
 * order. */
static void take_rows(const solution *x, const double *b)
{
    for (size_t k = 0, end; (k = next_needed(x, k, &end)) < x->factor->n; k = end)
        for (size_t done = 0, width; done < x->n_rhs; done += width) {
            const group g = group_at(x->factor, x->n_rhs, done, x->work);
            width = g.width;
            for (size_t i = k; i < end; ++i)
                memcpy(g.value + i * width, b + x->factor->order[i] * x->n_rhs + done,
                       width * sizeof *b);
        }
}

static void give_rows(const solution *x, double *b)
{
    for (size_t k = 0, end; (k = next_needed(x, k, &end)) < x->factor->n; k = end)
        for (size_t done = 0, width; done < x->n_rhs; done += width) {
            const group g = group_at(x->factor, x->n_rhs, done, x->work);
            width = g.width;
            for (size_t i = k; i < end; ++i)
                memcpy(b + x->factor->order[i] * x->n_rhs + done, g.value + i * width,
                       width * sizeof *b);
        }
}

static void solve(const iccp_ldlt *factor, const uint8_t *needed, size_t n_rhs, double *b,
                  double *work, const iccp_env *env)
{
    const solution all = {iccp_dense_choose(), factor, &factor->small, needed, n_rhs, work};
    take_rows(&all, b);
    if (env != NULL && iccp_has_threads(env) && factor->small.n > 1 &&
        factor->n_entries * n_rhs > FEW_ENTRIES)
        solve_by_subtrees(&all, env);
    else
        solve_in_turn(&all);
    give_rows(&all, b);
}

void iccp_ldlt_solve(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work)
{
    solve(factor, NULL, n_rhs, b, work, NULL);
}

void iccp_ldlt_solve_at_once(const iccp_ldlt *factor, size_t n_rhs, double *b, double *work,
                             const iccp_env *env)
{
    solve(factor, NULL, n_rhs, b, work, env);
}

/* A row's panel reaches its ancestors in the tree, and no other panels. */
void iccp_ldlt_mark(const iccp_ldlt *factor, size_t n, const uint32_t *rows, uint8_t *needed)
{
    const iccp_supernodes *nodes = &factor->nodes;
    for (size_t k = 0; k < n; ++k)
        for (uint32_t s = nodes->owner[factor->position[rows[k]]];
             s != ICCP_NO_PARENT && !needed[s]; s = nodes->parent[s])
            needed[s] = 1;
}

size_t iccp_ldlt_marked(const iccp_ldlt *factor, const uint8_t *needed, uint32_t *rows)
{
    size_t n = 0;
    for (uint32_t i = 0; i < factor->n; ++i)
        if (needed[factor->nodes.owner[factor->position[i]]])
            rows[n++] = i;
    return n;
}

void iccp_ldlt_solve_marked(const iccp_ldlt *factor, const uint8_t *needed, size_t n_rhs, double *b,
                            double *work)
{
    solve(factor, needed, n_rhs, b, work, NULL);
}

/* Lists the supernodes that the rows reach, in rising order. Children come before parents, so a
 * path from a row is in order already, and is merged with the list from behind. */
static size_t find_path(const iccp_ldlt *factor, size_t n, const uint32_t *rows, uint8_t *needed,
                        uint32_t *path)
{
    const iccp_supernodes *nodes = &factor->nodes;
    size_t length = 0;
    for (size_t k = 0; k < n; ++k) {
        const size_t old = length;
        for (uint32_t s = nodes->owner[factor->position[rows[k]]];
             s != ICCP_NO_PARENT && !needed[s]; s = nodes->parent[s]) {
            needed[s] = 1;
            path[length++] = s;
        }
        for (size_t i = old; i < length; ++i) {
            const uint32_t s = path[i];
            size_t j = i;
            for (; j > 0 && path[j - 1] > s; --j)
                path[j] = path[j - 1];
            path[j] = s;
        }
    }
    return length;
}

/* b' A^-1 b = y' D^-1 y with L y = b. */
void iccp_ldlt_forms(const iccp_ldlt *factor, size_t n, const uint32_t *rows, const double *values,
                     double form[ICCP_LDLT_FORMS], double *work, uint8_t *needed, uint32_t *path)
{
    const iccp_supernodes *nodes = &factor->nodes;
    const solution x = {.dense = iccp_dense_choose(), .factor = factor};
    const group g = {work, ICCP_LDLT_FORMS};
    for (size_t k = 0; k < n * ICCP_LDLT_FORMS; ++k)
        work[ICCP_LDLT_FORMS * (size_t)factor->position[rows[k / ICCP_LDLT_FORMS]] +
             k % ICCP_LDLT_FORMS] += values[k];
    for (size_t c = 0; c < ICCP_LDLT_FORMS; ++c)
        form[c] = 0;
    const size_t length = find_path(factor, n, rows, needed, path);
    for (size_t k = 0; k < length; ++k) {
        const uint32_t s = path[k];
        pass(factor, s, &g, &(range){0, rows_of(&x, s)}, &x.dense);
        for (size_t i = nodes->column[s]; i < nodes->column[s + 1]; ++i)
            for (size_t c = 0; c < ICCP_LDLT_FORMS; ++c) {
                double *y = &work[ICCP_LDLT_FORMS * i + c];
                form[c] += *y * *y / factor->pivot[i];
                *y = 0;
            }
        needed[s] = 0;
    }
}
