/* A uniform grid of cells, each with a list of the triangles near it: J. L. Bentley, B. W. Weide,
 * A. C. Yao, Optimal expected-time algorithms for closest point problems, 1980. Points of a batch
 * are processed stage by stage, so that their memory accesses overlap. */
#include "mesh/finder.h"

#include "base/budget.h"
#include "base/compiler.h"
#include "base/minmax.h"
#include "math/predicates.h"

#include <math.h>

/* The grid. A last, extra cell stands for everything outside the box. It has no triangles and
 * counts as near the boundary. */
typedef struct grid {
    double lower[2], upper[2]; /* the mesh's box */
    double rate;               /* cell = (point - lower) * rate */
    /* In cells: a triangle is also listed in cells that it misses by less */
    double slack;
    size_t size[2], n_cells;
    bool is_large; /* the mesh and its grid exceed the processor's own cache */
    /* n_cells + 2: twice the place in `entries` where a cell's triangles begin, plus 1 if the
     * mesh's boundary is near the cell */
    uint32_t *first;
    uint32_t *entries; /* triangles, cell by cell, in rising order */
} grid;

/* Cells per triangle. With FEW, a map of 400 vertices takes 2 % less time to make than with SOME.
 * Points through its charts then cost up to 3 % more. With MANY, most points lie in the first
 * triangle of their cell. That pays for up to LARGE cells. */
static const double FEW = 1, SOME = 4, MANY = 16, LARGE = 1 << 19;

/* Entries per triangle that need no budget: about twice as many as well-shaped meshes have. */
static const double PLENTY = 64;

/* Bytes that stay in a second-level cache. */
static const size_t CACHE = (size_t)1 << 20;

/* Least ratio of twice a triangle's area to the products that it is the sum of. Below it,
 * barycentric coordinates in plain doubles would be wrong by more than 1e-14. */
static const double FLATTEST = 0.05;

/* For numbers only: iccp_min() also handles NaN, which takes 2 % of the time of a map. */
static inline double least(double a, double b)
{
    return a < b ? a : b;
}

static inline double most(double a, double b)
{
    return a > b ? a : b;
}

static inline size_t cell_of(double x, size_t n)
{
    return x > 0 ? (x < (double)n ? (size_t)(ptrdiff_t)x : n - 1) : 0;
}

/* ---- the cells that an edge or a triangle meets ---- */

/* An edge from its lower end upwards, in cells. */
typedef struct edge {
    double x, bottom, x_top, top, slope;
} edge;

static inline void in_cells(const iccp_finder *f, const grid *g, uint32_t vertex, double q[2])
{
    const double *p = f->points + 2 * (size_t)vertex;
    q[0] = (p[0] - g->lower[0]) * g->rate;
    q[1] = (p[1] - g->lower[1]) * g->rate;
}

static inline edge edge_of(const double a[2], const double b[2])
{
    const double *low = a[1] < b[1] ? a : b, *high = a[1] < b[1] ? b : a;
    const double height = high[1] - low[1];
    return (edge){low[0], low[1], high[0], high[1], height > 0 ? (high[0] - low[0]) / height : 0};
}

/* Extends [low, high] by the part of the edge with y in [bottom, top]. */
static inline void clip(const edge *e, double bottom, double top, double *low, double *high)
{
    if (e->top < bottom || e->bottom > top)
        return;
    const double x0 = e->bottom >= bottom ? e->x : e->x + (bottom - e->bottom) * e->slope;
    const double x1 = e->top <= top ? e->x_top : e->x + (top - e->bottom) * e->slope;
    const double inner = least(e->x, e->x_top), outer = most(e->x, e->x_top);
    *low = least(*low, most(least(x0, x1), inner));
    *high = most(*high, least(most(x0, x1), outer));
}

/* Finds the cells of a row that n edges come near to: [begin, end). */
static inline void span_of(const grid *g, const edge *e, size_t n, size_t row, double slack,
                           size_t *begin, size_t *end)
{
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (size_t k = 0; k < n; ++k)
        clip(&e[k], (double)row - slack, (double)row + 1 + slack, &low, &high);
    *begin = g->size[0] * row + cell_of(low - slack, g->size[0]);
    *end = g->size[0] * row + cell_of(high + slack, g->size[0]) + (low <= high);
}

/* Counts the triangle in its cells, or enters it into them, backwards. */
static ICCP_INLINE void visit_triangle(const iccp_finder *f, grid *g, uint32_t triangle,
                                       bool enters)
{
    const uint32_t *v = f->triangles + 3 * (size_t)triangle;
    double q[3][2];
    for (int k = 0; k < 3; ++k)
        in_cells(f, g, v[k], q[k]);
    const double bottom = least(least(q[0][1], q[1][1]), q[2][1]);
    const double top = most(most(q[0][1], q[1][1]), q[2][1]);
    const size_t last = cell_of(top + g->slack, g->size[1]);
    const edge e[3] = {edge_of(q[0], q[1]), edge_of(q[1], q[2]), edge_of(q[2], q[0])};
    for (size_t row = cell_of(bottom - g->slack, g->size[1]); row <= last; ++row) {
        size_t cell, end;
        span_of(g, e, 3, row, g->slack, &cell, &end);
        for (; cell < end; ++cell)
            if (enters)
                g->entries[(g->first[cell] -= 2) / 2] = triangle;
            else
                g->first[cell] += 2;
    }
}

/* Marks the cells within `slack` of an edge. */
static void mark_edge(const iccp_finder *f, grid *g, uint32_t from, uint32_t to, double slack)
{
    double a[2], b[2];
    in_cells(f, g, from, a);
    in_cells(f, g, to, b);
    const edge e = edge_of(a, b);
    const size_t last = cell_of(e.top + slack, g->size[1]);
    for (size_t row = cell_of(e.bottom - slack, g->size[1]); row <= last; ++row) {
        size_t cell, end;
        span_of(g, &e, 1, row, slack, &cell, &end);
        for (; cell < end; ++cell)
            g->first[cell] |= 1;
    }
}

/* ---- making the grid ---- */

/* The slack covers the rounding of coordinates in cells. Rows need it too, because flat edges
 * magnify an error of y. */
static void choose_cells(const iccp_finder *f, grid *g)
{
    for (int k = 0; k < 2; ++k) {
        g->lower[k] = HUGE_VAL;
        g->upper[k] = -HUGE_VAL;
    }
    for (size_t v = 0; v < f->n_vertices; ++v)
        for (int k = 0; k < 2; ++k) {
            g->lower[k] = least(g->lower[k], f->points[2 * v + (size_t)k]);
            g->upper[k] = most(g->upper[k], f->points[2 * v + (size_t)k]);
        }
    const double width = g->upper[0] - g->lower[0], height = g->upper[1] - g->lower[1];
    const double longest = most(width, height), n = (double)f->n_triangles;
    g->rate = sqrt(f->density * n / most(width * height, longest * longest / n));
    g->size[0] = (size_t)(width * g->rate) + 1;
    g->size[1] = (size_t)(height * g->rate) + 1;
    g->n_cells = g->size[0] * g->size[1];
    g->slack = 1e-9 + 0x1p-50 * longest * g->rate;
}

/* Marks the cells within four times the reach as near the boundary. A mesh's boundary follows its
 * domain's within one and a half times the reach (map/apply.c). If that exceeds a cell, all cells
 * are marked. */
static void mark_boundary(const iccp_finder *f, grid *g)
{
    const double slack = g->slack + 4 * f->reach * g->rate;
    for (size_t cell = 0; cell < g->n_cells && slack > 1; ++cell)
        g->first[cell] |= 1;
    for (uint32_t c = 0; c < 3 * f->n_triangles && slack <= 1; ++c)
        if (f->twins[c] == ICCP_NO_NEIGHBOUR)
            mark_edge(f, g, f->triangles[iccp_after(c)], f->triangles[iccp_before(c)], slack);
}

/* Turns counts into the ends of the cells. Returns false if there are too many entries. */
static bool find_ends(grid *g)
{
    uint64_t end = 0;
    for (size_t cell = 0; cell < g->n_cells; ++cell) {
        end += g->first[cell] & ~(uint32_t)1;
        g->first[cell] = (uint32_t)end | (g->first[cell] & 1);
        if (end >= UINT32_MAX)
            return false;
    }
    g->first[g->n_cells] = (uint32_t)end | 1;
    g->first[g->n_cells + 1] = (uint32_t)end;
    return true;
}

static void free_grid(grid *g, const iccp_memory *memory)
{
    if (g != NULL) {
        iccp_free(memory, g->first);
        iccp_free(memory, g->entries);
    }
    iccp_free(memory, g);
}

/* Makes two passes over the triangles. The first counts the entries of each cell. The second fills
 * them in backwards, which moves `first` from the ends of the cells to their beginnings. */
static grid *make_grid(const iccp_finder *f)
{
    grid *g = iccp_alloc_zero(&f->memory, 1, sizeof *g);
    if (g == NULL)
        return NULL;
    choose_cells(f, g);
    g->first = iccp_alloc_zero(&f->memory, g->n_cells + 2, sizeof *g->first);
    if (g->first != NULL) {
        for (uint32_t t = 0; t < f->n_triangles; ++t)
            visit_triangle(f, g, t, false);
        mark_boundary(f, g);
        if (find_ends(g))
            g->entries = iccp_alloc(&f->memory, g->first[g->n_cells + 1] / 2, sizeof *g->entries);
    }
    if (g->entries == NULL) {
        free_grid(g, &f->memory);
        return NULL;
    }
    for (uint32_t t = (uint32_t)f->n_triangles; t-- > 0;)
        visit_triangle(f, g, t, true);
    const size_t mesh = 12 * f->n_triangles + 32 * f->n_vertices;
    g->is_large = mesh + 4 * g->n_cells + 2 * (size_t)g->first[g->n_cells + 1] > CACHE;
    return g;
}

static const grid *grid_of(const iccp_finder *f)
{
    const grid *known = iccp_once_get(&f->grid);
    if (ICCP_LIKELY(known != NULL))
        return known;
    grid *fresh = make_grid(f);
    if (fresh == NULL)
        return NULL;
    known = iccp_once_keep(&f->grid, fresh);
    if (known != fresh)
        free_grid(fresh, &f->memory);
    return known;
}

void iccp_finder_init(iccp_finder *finder, const iccp_planar *mesh, const double *points,
                      double reach, iccp_demand demand, const iccp_memory *memory)
{
    finder->memory = *memory;
    finder->points = points;
    finder->triangles = mesh->triangles;
    finder->twins = mesh->twins;
    finder->n_vertices = mesh->n_vertices;
    finder->n_triangles = mesh->n_triangles;
    finder->density = FEW;
    if (demand == ICCP_MANY_POINTS)
        finder->density = most(SOME, least(MANY, LARGE / (double)mesh->n_triangles));
    finder->reach = reach;
    iccp_once_init(&finder->grid);
}

void iccp_finder_free(iccp_finder *finder)
{
    free_grid(iccp_once_get(&finder->grid), &finder->memory);
    iccp_once_init(&finder->grid);
}

icc_status iccp_finder_ready(const iccp_finder *finder)
{
    return grid_of(finder) != NULL ? ICC_OK : ICC_ERR_MEMORY;
}

/* Bounds the number of cells that a triangle meets: its area in cells, plus 2 for each grid line
 * that it crosses. These are as many as the lengths of its edges along the axes, plus 4. */
icc_status iccp_finder_budget(const iccp_finder *finder, const iccp_env *env)
{
    const iccp_finder *f = finder;
    if (env->budget == NULL)
        return ICC_OK;
    grid g = {0};
    choose_cells(f, &g);
    double length = 0;
    for (uint32_t c = 0; c < 3 * f->n_triangles; ++c) {
        const double *a = f->points + 2 * (size_t)f->triangles[c];
        const double *b = f->points + 2 * (size_t)f->triangles[iccp_after(c)];
        length += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    }
    const double n = (double)f->n_triangles;
    const double n_entries = (double)g.n_cells + 4 * n + length * g.rate;
    return n_entries > PLENTY * n ? iccp_budget_borrow(env, n_entries * sizeof *g.entries) : ICC_OK;
}

/* ---- finding points ---- */

/* Share of the sum of magnitudes that rounding cannot exceed when an area is computed. If the area
 * exceeds it, the sign is right. */
static const double CERTAIN = 1e-15;

/* Decides doubtful cases: p is next to an edge, or the triangle is flat. */
static bool holds_exactly(const iccp_finder *f, const uint32_t *v, const double p[2],
                          double bary[3])
{
    const double *const q[3] = {f->points + 2 * (size_t)v[0], f->points + 2 * (size_t)v[1],
                                f->points + 2 * (size_t)v[2]};
    for (int k = 0; k < 3; ++k)
        if (iccp_orient2d(q[(k + 1) % 3], q[(k + 2) % 3], p) < 0)
            return false;
    for (int k = 0; k < 3; ++k)
        bary[k] = iccp_max(iccp_area2d(q[(k + 1) % 3], q[(k + 2) % 3], p), 0);
    return bary[0] + bary[1] + bary[2] > 0;
}

/* Returns true if the triangle contains p, exactly; `bary` are then the areas between p and the
 * edges. Computes and compares all three before it decides, so only one branch is hard to predict
 * instead of three. */
static ICCP_INLINE bool holds(const iccp_finder *f, uint32_t triangle, const double p[2],
                              double bary[3])
{
    const uint32_t *v = f->triangles + 3 * (size_t)triangle;
    const double *a = f->points + 2 * (size_t)v[0], *b = f->points + 2 * (size_t)v[1];
    const double *c = f->points + 2 * (size_t)v[2];
    const double ax = a[0] - p[0], ay = a[1] - p[1], bx = b[0] - p[0];
    const double by = b[1] - p[1], cx = c[0] - p[0], cy = c[1] - p[1];
    const double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
    const double size = fabs(bc) + fabs(cb) + fabs(ca) + fabs(ac) + fabs(ab) + fabs(ba);
    const double area[3] = {bc - cb, ca - ac, ab - ba}, limit = CERTAIN * size;
    if ((area[0] < -limit) | (area[1] < -limit) | (area[2] < -limit))
        return false;
    for (int k = 0; k < 3; ++k)
        bary[k] = area[k];
    if ((area[0] > limit) & (area[1] > limit) & (area[2] > limit) &
        (area[0] + area[1] + area[2] > FLATTEST * size))
        return true;
    return holds_exactly(f, v, p, bary);
}

static inline size_t cell_at(const grid *g, const double p[2])
{
    if (!(p[0] >= g->lower[0] && p[0] <= g->upper[0] && p[1] >= g->lower[1] && p[1] <= g->upper[1]))
        return g->n_cells;
    return cell_of((p[0] - g->lower[0]) * g->rate, g->size[0]) +
           g->size[0] * cell_of((p[1] - g->lower[1]) * g->rate, g->size[1]);
}

static ICCP_INLINE bool find_in(const iccp_finder *f, uint32_t triangle, const double p[2],
                                iccp_found *found)
{
    if (!holds(f, triangle, p, found->bary))
        return false;
    const double scale = 1 / (found->bary[0] + found->bary[1] + found->bary[2]);
    for (int k = 0; k < 3; ++k)
        found->bary[k] *= scale;
    found->triangle = triangle;
    return true;
}

static ICCP_INLINE void find_in_cell(const iccp_finder *f, const grid *g, size_t cell,
                                     const double p[2], iccp_found *found)
{
    const uint32_t end = g->first[cell + 1] / 2;
    found->is_near = g->first[cell] & 1;
    found->triangle = ICCP_NO_NEIGHBOUR;
    for (uint32_t e = g->first[cell] / 2; e < end; ++e)
        if (find_in(f, g->entries[e], p, found))
            return;
}

icc_status iccp_finder_find(const iccp_finder *finder, const double p[2], iccp_found *found)
{
    const grid *g = grid_of(finder);
    if (g == NULL)
        return ICC_ERR_MEMORY;
    find_in_cell(finder, g, cell_at(g, p), p, found);
    return found->triangle != ICCP_NO_NEIGHBOUR ? ICC_OK : ICC_ERR_TRACE;
}

icc_status iccp_finder_find_alone(const iccp_finder *finder, const double p[2], iccp_found *found)
{
    for (uint32_t t = 0; t < finder->n_triangles; ++t)
        if (find_in(finder, t, p, found))
            return ICC_OK;
    return ICC_ERR_TRACE;
}

/* ---- many points ---- */

/* Number of a cell's triangles whose corners are fetched before it is known which one is needed. */
enum { AHEAD = 1 };

/* Returns true if most points are in the same cell as the previous point, or beside it. Their
 * memory has then just been read. */
static bool are_in_order(size_t n, const size_t *cell)
{
    size_t n_close = 0;
    for (size_t k = 1; k < n; ++k)
        n_close += cell[k] - cell[k - 1] + 2 <= 4;
    return 2 * n_close >= n;
}

/* Each stage reads, for all points, the memory that the previous stage has prefetched. */
static void fetch(const iccp_finder *f, const grid *g, size_t n, const size_t *cell)
{
    const uint32_t *entry[ICCP_FINDER_MANY];
    uint32_t n_entries[ICCP_FINDER_MANY];
    for (size_t k = 0; k < n; ++k)
        ICCP_PREFETCH(g->first + cell[k]);
    for (size_t k = 0; k < n; ++k) {
        const uint32_t first = g->first[cell[k]] / 2, last = g->first[cell[k] + 1] / 2;
        entry[k] = g->entries + first;
        n_entries[k] = last - first < AHEAD ? last - first : AHEAD;
        ICCP_PREFETCH(entry[k]);
    }
    for (size_t k = 0; k < n; ++k)
        for (uint32_t e = 0; e < n_entries[k]; ++e)
            ICCP_PREFETCH(f->triangles + 3 * (size_t)entry[k][e]);
    for (size_t k = 0; k < n; ++k)
        for (uint32_t e = 0; e < n_entries[k]; ++e)
            for (size_t c = 0; c < 3; ++c)
                ICCP_PREFETCH(f->points + 2 * (size_t)f->triangles[3 * (size_t)entry[k][e] + c]);
}

void iccp_finder_find_many(const iccp_finder *finder, size_t n, const double *points,
                           const double *other, iccp_found *found)
{
    const iccp_finder *f = finder;
    const grid *g = iccp_once_get(&f->grid);
    size_t cell[ICCP_FINDER_MANY];
    for (size_t k = 0; k < n; ++k)
        cell[k] = cell_at(g, points + 2 * k);
    const bool fetches = g->is_large && !are_in_order(n, cell);
    if (fetches)
        fetch(f, g, n, cell);
    for (size_t k = 0; k < n; ++k) {
        find_in_cell(f, g, cell[k], points + 2 * k, &found[k]);
        for (size_t c = 0; c < 3 && fetches && found[k].triangle != ICCP_NO_NEIGHBOUR; ++c)
            ICCP_PREFETCH(other + 2 * (size_t)f->triangles[3 * (size_t)found[k].triangle + c]);
    }
}
