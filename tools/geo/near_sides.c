/* A grid of cells with a few items each. An item is in all cells that its box meets, and its point
 * is compared in the one cell in which it lies. A cell with many items gets a grid of its own, which
 * spans the points in it. So it does not matter where in the plane the points crowd. */
#include "geo/near_sides.h"

#include "base/allocate.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum {
    FEW = 8,   /* points of a cell, on average */
    MANY = 64, /* items of a cell that gets a grid */
    MAX_DEPTH = 16
};

/* An item in a cell. Its point is compared there if `owns` is set. */
typedef struct entry {
    uint32_t item;
    bool owns;
} entry;

typedef struct search {
    const near_item *items;
    const double *points;
    double near;
    near_report *report;
    void *context;
} search;

typedef struct grid {
    double lower[2], rate[2];
    size_t n[2];
} grid;

static const double *point_of(const search *s, uint32_t point)
{
    return s->points + 2 * (size_t)point;
}

/* Grows with x, also by rounding. So a point in the box of an item lies in a cell of the item. */
static size_t cell_of(const grid *g, size_t k, double x)
{
    double cell = (x - g->lower[k]) * g->rate[k], last = (double)(g->n[k] - 1);
    return cell > 0 ? (size_t)(cell < last ? cell : last) : 0;
}

/* Makes cells that have FEW points on average, and are no smaller than the average item. */
static void choose_cells(const search *s, grid *g, size_t n, const entry *list)
{
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL}, size[2], sum = 0;
    size_t n_points = 0;
    for (size_t i = 0; i < n; i++) {
        const double *a = point_of(s, s->items[list[i].item].a),
                     *b = point_of(s, s->items[list[i].item].b);
        sum += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
        n_points += list[i].owns;
        for (size_t k = 0; list[i].owns && k < 2; k++) {
            lower[k] = a[k] < lower[k] ? a[k] : lower[k];
            upper[k] = a[k] > upper[k] ? a[k] : upper[k];
        }
    }
    double n_cells = (double)(n_points / FEW + 1), mean = sum / (2 * (double)n);
    for (size_t k = 0; k < 2; k++)
        size[k] = upper[k] - lower[k];
    double side = sqrt(size[0] / n_cells * size[1]);
    side = side > size[0] / n_cells ? side : size[0] / n_cells;
    side = side > size[1] / n_cells ? side : size[1] / n_cells;
    side = side > mean ? side : mean;
    for (size_t k = 0; k < 2; k++) {
        double wanted = size[k] / side;
        g->lower[k] = lower[k];
        g->n[k] = wanted >= 1 ? (size_t)wanted : 1;
        g->rate[k] = g->n[k] > 1 ? (double)g->n[k] / size[k] : 0;
    }
}

/* Counts an item in its cells if out == NULL, else enters it there, backwards. */
static void enter(const search *s, const grid *g, entry e, size_t *at, entry *out)
{
    const double *a = point_of(s, s->items[e.item].a), *b = point_of(s, s->items[e.item].b);
    size_t first[2], last[2], own[2];
    for (size_t k = 0; k < 2; k++) {
        first[k] = cell_of(g, k, (a[k] < b[k] ? a[k] : b[k]) - s->near);
        last[k] = cell_of(g, k, (a[k] < b[k] ? b[k] : a[k]) + s->near);
        own[k] = cell_of(g, k, a[k]);
    }
    for (size_t y = first[1]; y <= last[1]; y++)
        for (size_t x = first[0]; x <= last[0]; x++)
            if (out == NULL)
                at[g->n[0] * y + x]++;
            else
                out[--at[g->n[0] * y + x]] = (entry){e.item, e.owns && x == own[0] && y == own[1]};
}

/* Some segments of a cell: where they begin, where they lead, and how far from them a point is near,
 * times their lengths. A point has none. */
typedef struct block {
    size_t n;
    const entry *list;
    double x[MANY], y[MANY], dx[MANY], dy[MANY], reach[MANY];
} block;

static void take_block(const search *s, block *out, size_t n, const entry *list)
{
    out->n = n;
    out->list = list;
    for (size_t j = 0; j < n; j++) {
        near_item item = s->items[list[j].item];
        const double *a = point_of(s, item.a), *b = point_of(s, item.b);
        out->x[j] = a[0];
        out->y[j] = a[1];
        out->dx[j] = b[0] - a[0];
        out->dy[j] = b[1] - a[1];
        out->reach[j] = item.a != item.b ? s->near * (fabs(out->dx[j]) + fabs(out->dy[j])) : -1;
    }
}

/* Reports segments of a block to which a point is close. False if the search has ended. */
static bool compare_point(const search *s, uint32_t point, const block *b)
{
    const double *p = point_of(s, point);
    for (size_t j = 0; j < b->n; j++) {
        double x = p[0] - b->x[j], y = p[1] - b->y[j], reach = b->reach[j];
        if (fabs(x * b->dy[j] - y * b->dx[j]) > reach)
            continue;
        double along = x * b->dx[j] + y * b->dy[j];
        double square = b->dx[j] * b->dx[j] + b->dy[j] * b->dy[j];
        near_item item = s->items[b->list[j].item];
        if (item.a == point || item.b == point || along < -reach || along > square + reach)
            continue;
        if (!s->report(s->context, point, b->list[j].item))
            return false;
    }
    return true;
}

/* Compares each point of a cell with all its segments. */
static bool compare(const search *s, size_t n, const entry *list)
{
    block b;
    for (size_t first = 0; first < n; first += MANY) {
        take_block(s, &b, n - first < MANY ? n - first : MANY, list + first);
        for (size_t i = 0; i < n; i++)
            if (list[i].owns && !compare_point(s, s->items[list[i].item].a, &b))
                return false;
    }
    return true;
}

/* Divides the items of a cell among the cells of a grid. False if the search has ended. */
static bool divide(const search *s, size_t n, const entry *list, int depth)
{
    grid g;
    choose_cells(s, &g, n, list);
    size_t n_cells = g.n[0] * g.n[1];
    if (n_cells == 1)
        return compare(s, n, list);
    size_t *first = need(n_cells + 1, sizeof *first);
    for (size_t i = 0; i < n; i++)
        enter(s, &g, list[i], first, NULL);
    for (size_t cell = 0; cell < n_cells; cell++)
        first[cell + 1] += first[cell];
    entry *entries = need(first[n_cells], sizeof *entries);
    for (size_t i = n; i-- > 0;)
        enter(s, &g, list[i], first, entries);
    bool goes_on = true;
    for (size_t cell = 0; cell < n_cells && goes_on; cell++) {
        size_t n_own = first[cell + 1] - first[cell];
        goes_on = n_own > MANY && depth < MAX_DEPTH
                      ? divide(s, n_own, entries + first[cell], depth + 1)
                      : compare(s, n_own, entries + first[cell]);
    }
    free(first);
    free(entries);
    return goes_on;
}

void near_sides(size_t n, const near_item *items, size_t n_points, const double *points,
                double near, near_report *report, void *context)
{
    const search s = {items, points, near, report, context};
    bool *seen = need(n_points, sizeof *seen);
    entry *list = need(n, sizeof *list);
    for (size_t i = 0; i < n; i++) {
        list[i] = (entry){(uint32_t)i, !seen[items[i].a]};
        seen[items[i].a] = true;
    }
    free(seen);
    if (n > 0)
        divide(&s, n, list, 0);
    free(list);
}

double near_rounded(double near, double largest)
{
    return near + 32 * DBL_EPSILON * largest;
}
