/* A regular grid with about as many cells as the cage has edges. In each row, a segment is in the
 * cells that it passes. So n edges are in O(n sqrt n) cells, however long they are. */
#include "geo/cage_grid.h"

#include "base/allocate.h"
#include "base/extremes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The cells first..last of one row, or rows first..last of the grid. */
typedef struct range {
    size_t first, last;
} range;

/* The cells along axis k between two coordinates. */
static range cells_between(const cage_grid *g, size_t k, double low, double high)
{
    double last = (double)g->n[k] - 1;
    double from = (low - g->near - g->corner[k]) / g->cell[k],
           to = (high + g->near - g->corner[k]) / g->cell[k];
    return (range){from > 0 ? (size_t)lesser(from, last) : 0,
                   to > 0 ? (size_t)lesser(to, last) : 0};
}

/* The cells of a row that a segment passes. A segment that reaches far beyond the cage counts in
 * all cells between its ends, because rounding would hide where exactly it passes. */
static range cells_of_row(const cage_grid *g, size_t row, const double a[2], const double b[2])
{
    double dx = b[0] - a[0], dy = b[1] - a[1], low = lesser(a[0], b[0]), high = greater(a[0], b[0]);
    double far = 1e3 * (g->cage->size + g->near);
    if (fabs(dy) > 0 && fabs(dx) < far && fabs(dy) < far) {
        double y = g->corner[1] + (double)row * g->cell[1];
        double s = (y - 2 * g->near - a[1]) / dy, t = (y + g->cell[1] + 2 * g->near - a[1]) / dy;
        double x = a[0] + lesser(greater(s, 0), 1) * dx, z = a[0] + lesser(greater(t, 0), 1) * dx;
        low = lesser(x, z);
        high = greater(x, z);
    }
    return cells_between(g, 0, low, high);
}

/* Counts the edge in its cells if edges == NULL, else lists it there. */
static void enter_edge(cage_grid *g, uint32_t edge, size_t *fill)
{
    const double *a = cage_end(g->cage, edge, 0), *b = cage_end(g->cage, edge, 1);
    range rows = cells_between(g, 1, lesser(a[1], b[1]), greater(a[1], b[1]));
    for (size_t row = rows.first; row <= rows.last; row++) {
        range columns = cells_of_row(g, row, a, b);
        for (size_t i = columns.first; i <= columns.last; i++) {
            size_t at = fill[row * g->n[0] + i]++;
            if (g->edges != NULL)
                g->edges[at] = edge;
        }
    }
}

void cage_grid_make(cage_grid *out, const carrier *cage, double near)
{
    size_t n_edges = cage->n_facets, side = (size_t)ceil(sqrt((double)n_edges));
    *out = (cage_grid){.cage = cage, .near = near, .n = {side, side}};
    for (size_t k = 0; k < 2; k++) {
        out->corner[k] = cage->lower[k];
        out->cell[k] = greater(cage->upper[k] - cage->lower[k], near) / (double)side;
    }
    size_t n_cells = side * side;
    out->starts = need(n_cells + 1, sizeof *out->starts);
    size_t *fill = need(n_cells + 1, sizeof *fill);
    for (size_t e = 0; e < n_edges; e++)
        enter_edge(out, (uint32_t)e, fill);
    for (size_t i = 0; i < n_cells; i++)
        out->starts[i + 1] = out->starts[i] + fill[i];
    memcpy(fill, out->starts, n_cells * sizeof *fill);
    out->edges = need(out->starts[n_cells], sizeof *out->edges);
    for (size_t e = 0; e < n_edges; e++)
        enter_edge(out, (uint32_t)e, fill);
    free(fill);
    out->asked = need(n_edges, sizeof *out->asked);
    out->found = need(n_edges, sizeof *out->found);
}

void cage_grid_free(cage_grid *grid)
{
    free(grid->starts);
    free(grid->edges);
    free(grid->asked);
    free(grid->found);
    *grid = (cage_grid){0};
}

static bool misses_box(const cage_grid *g, const double a[2], const double b[2])
{
    for (size_t k = 0; k < 2; k++)
        if (greater(a[k], b[k]) < g->cage->lower[k] - g->near ||
            lesser(a[k], b[k]) > g->cage->upper[k] + g->near)
            return true;
    return false;
}

static void begin_question(cage_grid *g)
{
    g->n_found = 0;
    if (++g->question == 0) {
        memset(g->asked, 0, g->cage->n_facets * sizeof *g->asked);
        g->question = 1;
    }
}

/* Adds to the result the edges in some cells of a row that are not in it yet. */
static void answer(cage_grid *g, size_t row, range columns)
{
    for (size_t cell = row * g->n[0] + columns.first; cell <= row * g->n[0] + columns.last; cell++)
        for (size_t k = g->starts[cell]; k < g->starts[cell + 1]; k++) {
            uint32_t edge = g->edges[k];
            if (g->asked[edge] != g->question)
                g->found[g->n_found++] = edge;
            g->asked[edge] = g->question;
        }
}

void cage_grid_ask(cage_grid *g, const double a[2], const double b[2])
{
    begin_question(g);
    if (misses_box(g, a, b))
        return;
    range rows = cells_between(g, 1, lesser(a[1], b[1]), greater(a[1], b[1]));
    for (size_t row = rows.first; row <= rows.last; row++)
        answer(g, row, cells_of_row(g, row, a, b));
}

void cage_grid_ask_box(cage_grid *g, const double lower[2], const double upper[2])
{
    begin_question(g);
    range rows = cells_between(g, 1, lower[1], upper[1]);
    range columns = cells_between(g, 0, lower[0], upper[0]);
    for (size_t row = rows.first; row <= rows.last; row++)
        answer(g, row, columns);
}

/* True if an edge comes close to a box: their boxes overlap, and the line does not pass beside the
 * box. */
static bool meets(const cage_grid *g, uint32_t edge, const double lower[2], const double upper[2])
{
    const double *a = cage_end(g->cage, edge, 0), *b = cage_end(g->cage, edge, 1);
    double middle[2], reach[2], d[2];
    for (size_t k = 0; k < 2; k++) {
        middle[k] = lower[k] / 2 + upper[k] / 2 - a[k];
        reach[k] = upper[k] / 2 - lower[k] / 2 + 2 * g->near;
        d[k] = b[k] - a[k];
        if (greater(a[k], b[k]) < lower[k] - 2 * g->near ||
            lesser(a[k], b[k]) > upper[k] + 2 * g->near)
            return false;
    }
    return !(fabs(d[0] * middle[1] - d[1] * middle[0]) >
             fabs(d[0]) * reach[1] + fabs(d[1]) * reach[0]);
}

bool cage_grid_is_far(cage_grid *g, const double lower[2], const double upper[2])
{
    cage_grid_ask_box(g, lower, upper);
    for (size_t i = 0; i < g->n_found; i++)
        if (meets(g, g->found[i], lower, upper))
            return false;
    return true;
}
