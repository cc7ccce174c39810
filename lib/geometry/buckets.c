/* Point in polygon with a uniform grid. Based on the "grid method" of E. Haines, Point in polygon
 * strategies (Graphics Gems IV, 1994), made exact. The search goes straight from the query to a
 * point of the same cell with a known answer, and counts the edges that it crosses. */
#include "geometry/buckets.h"

#include "base/minmax.h"
#include "geometry/frame.h"
#include "geometry/segment.h"
#include "math/predicates.h"

#include <assert.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

/* Chosen with tests/bench/bench_domain.c: more cells do not make queries faster, fewer make them
 * slower. The total number of entries is bounded to limit memory when long edges crowd the box. An
 * edge counts once in each of its cells. */
enum {
    MIN_CELLS = 1024,
    CELLS_PER_EDGE = 4,
    MAX_CELLS = 1 << 26,
    ENTRIES_PER_EDGE = 16 /* approximate maximum */
};

/* An edge belongs to all cells within this distance, in units of the band's reach. The reach itself
 * is at least about 20 units in the last place of the coordinates (frame.h: the box is at least 1/4
 * long). The rest covers rounding in the computation of cells. */
static const double SLACK = 4;

static const double *edge_start(const iccp_buckets *b, size_t edge)
{
    return b->points + 2 * edge;
}

/* Returns the column (axis 0) or row (axis 1) of a coordinate. Coordinates beyond the grid go to
 * its border. */
static uint32_t slot(const iccp_buckets *b, int axis, double x)
{
    const double s = (x - b->origin[axis]) * b->rate[axis];
    const uint32_t last = b->size[axis] - 1;
    return s >= (double)last ? last : s > 0 ? (uint32_t)s : 0;
}

/* Chooses the shape of cells so that as few edges as possible share one. If Lx and Ly are the
 * lengths of the polygon along the axes, edges cross about Lx / hx + Ly / hy sides of cells. For a
 * given cell area this is least when hx / hy = Lx / Ly. Column 0 lies outside the box, so each row
 * starts outside. */
static void choose_cells(iccp_buckets *b)
{
    const double slack = SLACK * b->band.reach, n = (double)b->n;
    double length[2] = {0, 0}, side[2], count[2];
    for (size_t k = 0; k < b->n; ++k)
        for (int axis = 0; axis < 2; ++axis)
            length[axis] += fabs(edge_start(b, k)[2 + axis] - edge_start(b, k)[axis]);
    for (int axis = 0; axis < 2; ++axis) {
        side[axis] = b->upper[axis] - b->lower[axis] + 2 * slack;
        length[axis] += slack;
    }
    const double cells = iccp_max(MIN_CELLS, iccp_min(CELLS_PER_EDGE * n, MAX_CELLS));
    count[0] = sqrt(cells * side[0] * length[1] / (side[1] * length[0]));
    count[0] = iccp_max(1, iccp_min(count[0], cells));
    count[1] = cells / count[0];
    const double entries = length[0] / side[0] * count[0] + length[1] / side[1] * count[1];
    const double shrink = iccp_min(1, (ENTRIES_PER_EDGE * n + MIN_CELLS) / entries);
    for (int axis = 0; axis < 2; ++axis) {
        count[axis] = iccp_min(count[axis] * shrink, side[axis] / (4 * slack));
        count[axis] = iccp_max(1, floor(count[axis]));
        b->step[axis] = side[axis] / count[axis];
        b->rate[axis] = count[axis] / side[axis];
        b->size[axis] = (uint32_t)count[axis];
        b->origin[axis] = b->lower[axis] - slack;
    }
    b->origin[0] -= b->step[0];
    ++b->size[0];
}

/* Returns x where an edge that rises from a to b passes height y, limited to its ends. */
static double x_at(const double *a, const double *b, double y)
{
    if (y <= a[1])
        return a[0];
    if (y >= b[1])
        return b[0];
    return a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
}

/* Counts an edge in its cells. If `edges` is not NULL, enters the edge into them, backwards from
 * their ends. */
static void enter(iccp_buckets *b, uint32_t edge, uint32_t *edges)
{
    const double slack = SLACK * b->band.reach;
    const double *low = edge_start(b, edge), *high = low + 2;
    if (low[1] > high[1]) {
        low = high;
        high = edge_start(b, edge);
    }
    const uint32_t last_row = slot(b, 1, high[1] + slack);
    for (uint32_t row = slot(b, 1, low[1] - slack); row <= last_row; ++row) {
        const double bottom = b->origin[1] + row * b->step[1];
        const double x0 = x_at(low, high, bottom - slack);
        const double x1 = x_at(low, high, bottom + b->step[1] + slack);
        const uint32_t last = slot(b, 0, iccp_max(x0, x1) + slack);
        iccp_bucket *const cells = b->cells + (size_t)row * b->size[0];
        for (uint32_t column = slot(b, 0, iccp_min(x0, x1) - slack); column <= last; ++column) {
            if (edges != NULL)
                edges[--cells[column].first] = edge;
            else
                ++cells[column].first;
        }
    }
}

/* Candidates for the known point of a cell lie on a parabola. A line meets it at most twice, so one
 * of the first 2 m + 1 candidates lies on none of m edges. */
static void candidate(const iccp_buckets *b, uint32_t row, uint32_t column, uint32_t number,
                      double *p)
{
    double u = 0.5 + 0.6180339887498949 * number;
    u -= floor(u);
    p[0] = b->origin[0] + (column + u) * b->step[0];
    p[1] = b->origin[1] + (row + 0.25 + 0.5 * u * u) * b->step[1];
}

/* Returns true if the segment from p to q crosses the edge; neither end lies on it. An end of the
 * edge on the line through p and q counts as left of the line. So of two edges that meet there,
 * both or one or none cross, as is right. */
static bool crosses(const iccp_buckets *b, uint32_t edge, const double *p, const double *q)
{
    const double *start = edge_start(b, edge), *end = start + 2;
    if ((iccp_orient2d(p, q, start) >= 0) == (iccp_orient2d(p, q, end) >= 0))
        return false;
    return iccp_orient2d(start, end, p) != iccp_orient2d(start, end, q);
}

static bool on_an_edge(const iccp_buckets *b, const iccp_bucket *cell, const double *p)
{
    for (uint32_t i = cell->first; i < cell[1].first; ++i)
        if (iccp_segment_has(edge_start(b, b->edges[i]), edge_start(b, b->edges[i]) + 2, p))
            return true;
    return false;
}

/* Returns true if the way from known point p of the cell to known point q of the next one changes
 * between inside and outside. The edges of each cell are in ascending order. */
static bool changes(const iccp_buckets *b, const iccp_bucket *cell, const double *p,
                    const double *q)
{
    bool odd = false;
    uint32_t i = cell[0].first, j = cell[1].first;
    while (i < cell[1].first || j < cell[2].first) {
        const uint32_t e = i < cell[1].first ? b->edges[i] : UINT32_MAX;
        const uint32_t f = j < cell[2].first ? b->edges[j] : UINT32_MAX;
        odd ^= crosses(b, e < f ? e : f, p, q);
        i += e <= f;
        j += f <= e;
    }
    return odd;
}

/* Finds the known point of every cell of a row, and whether it lies inside. */
static void explore_row(iccp_buckets *b, uint32_t row)
{
    iccp_bucket *const cells = b->cells + (size_t)row * b->size[0];
    double p[2], q[2];
    bool inside = false;
    candidate(b, row, 0, 0, p);
    cells[0].state = 0;
    for (uint32_t column = 1; column < b->size[0]; ++column) {
        uint32_t number = 0;
        candidate(b, row, column, number, q);
        while (on_an_edge(b, &cells[column], q))
            candidate(b, row, column, ++number, q);
        inside ^= changes(b, &cells[column - 1], p, q);
        cells[column].state = 2 * number + inside;
        memcpy(p, q, sizeof p);
    }
}

void iccp_buckets_start(iccp_buckets *buckets, const iccp_polygon *polygon, const double *lower,
                        const double *upper, const iccp_band *band)
{
    *buckets = (iccp_buckets){.points = polygon->points, .n = polygon->n, .band = *band};
    for (int axis = 0; axis < 2; ++axis) {
        buckets->lower[axis] = lower[axis] - band->reach;
        buckets->upper[axis] = upper[axis] + band->reach;
    }
}

icc_status iccp_buckets_fill(iccp_buckets *buckets, const iccp_memory *memory)
{
    iccp_buckets *const b = buckets;
    choose_cells(b);
    const size_t n_cells = (size_t)b->size[0] * b->size[1];
    b->cells = iccp_alloc_zero(memory, n_cells + 1, sizeof *b->cells);
    if (b->cells == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t edge = 0; edge < b->n; ++edge)
        enter(b, edge, NULL);
    uint32_t n_entries = 0;
    for (size_t i = 0; i <= n_cells; ++i)
        b->cells[i].first = n_entries += b->cells[i].first;
    b->edges = iccp_alloc(memory, n_entries, sizeof *b->edges);
    if (b->edges == NULL) {
        iccp_buckets_free(b, memory);
        return ICC_ERR_MEMORY;
    }
    for (uint32_t edge = (uint32_t)b->n; edge-- > 0;)
        enter(b, edge, b->edges);
    for (uint32_t row = 0; row < b->size[1]; ++row)
        explore_row(b, row);
    return ICC_OK;
}

void iccp_buckets_free(iccp_buckets *buckets, const iccp_memory *memory)
{
    iccp_free(memory, buckets->cells);
    iccp_free(memory, buckets->edges);
    *buckets = (iccp_buckets){0};
}

/* Returns true if p is farther than `distance` from the box of an edge. */
static bool far_from(const double *a, const double *p, double distance)
{
    return (p[0] < a[0] - distance && p[0] < a[2] - distance) ||
           (p[0] > a[0] + distance && p[0] > a[2] + distance) ||
           (p[1] < a[1] - distance && p[1] < a[3] - distance) ||
           (p[1] > a[1] + distance && p[1] > a[3] + distance);
}

/* Coordinates too small for the predicates become 0. That moves a point by far less than the
 * tolerance. */
static double digestible(double x)
{
    return fabs(x) < ICCP_FRAME_SMALLEST ? 0 : x;
}

/* Returns true if an edge lies beside the box of p and q, so that it cannot cross the segment
 * between them. */
static bool beside(const double *a, const double *p, const double *q)
{
    for (int k = 0; k < 2; ++k) {
        const double low = p[k] < q[k] ? p[k] : q[k], high = p[k] < q[k] ? q[k] : p[k];
        if ((a[k] < low && a[2 + k] < low) || (a[k] > high && a[2 + k] > high))
            return true;
    }
    return false;
}

/* Returns true if p belongs to the band of the edge from a, at share t of the edge. */
static bool in_band(const iccp_buckets *b, const double *a, double t, const double *p)
{
    const double gap[2] = {a[0] + t * (a[2] - a[0]) - p[0], a[1] + t * (a[3] - a[1]) - p[1]};
    return !iccp_band_is_wide(&b->band) || iccp_band_holds(&b->band, 2, gap);
}

/* Looks at edges[0] .. edges[n - 1], or at edges 0 .. n - 1. Starts from a point q on none of them
 * that is known to be inside or not. */
static iccp_location look(const iccp_buckets *b, size_t n, const uint32_t *edges, const double *q,
                          bool inside, const double *point)
{
    iccp_location place = {ICC_OUTSIDE, 0, 0};
    const double p[2] = {digestible(point[0]), digestible(point[1])};
    double best = b->band.reach * b->band.reach;
    for (size_t i = 0; i < n; ++i) {
        const uint32_t edge = edges != NULL ? edges[i] : (uint32_t)i;
        const double *a = edge_start(b, edge);
        double t;
        if (!far_from(a, p, b->band.reach)) {
            const double distance2 = iccp_segment_nearest(a, a + 2, p, &t);
            if ((distance2 < best || (distance2 == best && place.where != ICC_BOUNDARY)) &&
                in_band(b, a, t, p)) {
                best = distance2;
                place = (iccp_location){ICC_BOUNDARY, edge, t};
            }
        }
        if (!beside(a, p, q))
            inside ^= crosses(b, edge, p, q);
    }
    if (place.where != ICC_BOUNDARY)
        place.where = inside ? ICC_INSIDE : ICC_OUTSIDE;
    return place;
}

iccp_location iccp_buckets_find(const iccp_buckets *buckets, const double *point)
{
    const iccp_buckets *const b = buckets;
    double q[2] = {b->lower[0] - 1, b->lower[1] - 1};
    if (!(point[0] >= b->lower[0] && point[0] <= b->upper[0] && point[1] >= b->lower[1] &&
          point[1] <= b->upper[1]))
        return (iccp_location){ICC_OUTSIDE, 0, 0};
    if (b->cells == NULL)
        return look(b, b->n, NULL, q, false, point);
    const uint32_t row = slot(b, 1, point[1]), column = slot(b, 0, point[0]);
    const iccp_bucket *cell = b->cells + (size_t)row * b->size[0] + column;
    const bool inside = cell->state & 1;
    const size_t n = cell[1].first - cell->first;
    if (n == 0)
        return (iccp_location){inside ? ICC_INSIDE : ICC_OUTSIDE, 0, 0};
    candidate(b, row, column, cell->state / 2, q);
    return look(b, n, b->edges + cell->first, q, inside, point);
}
