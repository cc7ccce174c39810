/* A vertex between two others may go if no other vertex lies in the triangle of the three: then
 * nothing crosses the new side. Rounds take every second vertex where possible, until no vertex
 * goes. Vertices are looked up by squares of a grid as wide as a pixel. */
#include "cage/thin_polygons.h"

#include "base/allocate.h"
#include "base/orientation.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#define NONE SIZE_MAX

/* The vertices of all polygons; those that are left are linked. */
typedef struct rings {
    const double *points;
    size_t *after;        /* the next vertex of the polygon, or NONE if the vertex has gone */
    double low[2];        /* the corner of the grid */
    size_t wide, high;    /* its squares */
    size_t *first, *next; /* the vertices in each square */
    double distance;
} rings;

static const double *at(const rings *r, size_t v)
{
    return r->points + 2 * v;
}

static size_t column(const rings *r, double x, int axis)
{
    double c = floor(x - r->low[axis]);
    size_t most = (axis == 0 ? r->wide : r->high) - 1;
    return c <= 0 ? 0 : c >= (double)most ? most : (size_t)c;
}

static double distance_to_side(const double *p, const double *a, const double *b)
{
    double u[2] = {b[0] - a[0], b[1] - a[1]}, v[2] = {p[0] - a[0], p[1] - a[1]};
    double length = u[0] * u[0] + u[1] * u[1],
           along = length > 0 ? (u[0] * v[0] + u[1] * v[1]) / length : 0;
    along = along < 0 ? 0 : along > 1 ? 1 : along;
    return hypot(v[0] - along * u[0], v[1] - along * u[1]);
}

/* True if all vertices that were between a and b, in the polygon as it was, lie close to that
 * side. `first` and `end` bound the polygon. */
static bool is_close(const rings *r, size_t a, size_t b, size_t first, size_t end)
{
    for (size_t v = a + 1 < end ? a + 1 : first; v != b; v = v + 1 < end ? v + 1 : first)
        if (distance_to_side(at(r, v), at(r, a), at(r, b)) > r->distance)
            return false;
    return true;
}

static bool is_in(const double *p, const double *a, const double *b, const double *c, int turn)
{
    return turn * orientation(a, b, p) >= 0 && turn * orientation(b, c, p) >= 0 &&
           turn * orientation(c, a, p) >= 0;
}

/* True if a vertex other than the three lies in their triangle. */
static bool is_occupied(const rings *r, size_t a, size_t b, size_t c)
{
    const double *p = at(r, a), *q = at(r, b), *s = at(r, c);
    int turn = orientation(p, q, s);
    if (turn == 0)
        return false; /* b lies on the new side: nothing is swept */
    size_t x0 = column(r, fmin(p[0], fmin(q[0], s[0])), 0),
           x1 = column(r, fmax(p[0], fmax(q[0], s[0])), 0);
    size_t y0 = column(r, fmin(p[1], fmin(q[1], s[1])), 1),
           y1 = column(r, fmax(p[1], fmax(q[1], s[1])), 1);
    for (size_t y = y0; y <= y1; y++)
        for (size_t x = x0; x <= x1; x++)
            for (size_t v = r->first[y * r->wide + x]; v != NONE; v = r->next[v])
                if (v != a && v != b && v != c && r->after[v] != NONE &&
                    is_in(at(r, v), p, q, s, turn))
                    return true;
    return false;
}

static void put_in_grid(rings *r, size_t n)
{
    double high[2] = {-INFINITY, -INFINITY};
    r->low[0] = r->low[1] = INFINITY;
    for (size_t v = 0; v < n; v++)
        for (int k = 0; k < 2; k++) {
            r->low[k] = fmin(r->low[k], at(r, v)[k]);
            high[k] = fmax(high[k], at(r, v)[k]);
        }
    r->wide = (size_t)(high[0] - r->low[0]) + 1;
    r->high = (size_t)(high[1] - r->low[1]) + 1;
    r->first = need(r->wide * r->high, sizeof *r->first);
    r->next = need(n, sizeof *r->next);
    for (size_t i = 0; i < r->wide * r->high; i++)
        r->first[i] = NONE;
    for (size_t v = 0; v < n; v++) {
        size_t *square = &r->first[column(r, at(r, v)[1], 1) * r->wide + column(r, at(r, v)[0], 0)];
        r->next[v] = *square;
        *square = v;
    }
}

/* Goes once around a polygon and removes vertices that are not neighbours. Returns how many. */
static size_t go_around(rings *r, size_t first, size_t end, size_t *n_left)
{
    size_t n_removed = 0, start = first;
    while (r->after[start] == NONE)
        start++;
    for (size_t a = start, steps = *n_left; steps > 0 && *n_left > 3; steps--) {
        size_t b = r->after[a], c = r->after[b];
        if (is_close(r, a, c, first, end) && !is_occupied(r, a, b, c)) {
            r->after[a] = c;
            r->after[b] = NONE;
            n_removed++;
            --*n_left;
        }
        a = r->after[a];
    }
    return n_removed;
}

static size_t move_to_front(const rings *r, double *points, size_t n, size_t *firsts,
                            size_t n_polygons)
{
    size_t kept = 0, polygon = 0;
    for (size_t v = 0; v < n; v++) {
        if (polygon < n_polygons && v == firsts[polygon])
            firsts[polygon++] = kept;
        if (r->after[v] == NONE)
            continue;
        memmove(points + 2 * kept++, points + 2 * v, 2 * sizeof *points);
    }
    return kept;
}

size_t thin_polygons(double *points, size_t n, size_t *firsts, size_t n_polygons, double distance)
{
    rings r = {.points = points, .distance = distance};
    if (n == 0)
        return 0;
    r.after = need(n, sizeof *r.after);
    put_in_grid(&r, n);
    for (size_t k = 0; k < n_polygons; k++) {
        size_t first = firsts[k], end = k + 1 < n_polygons ? firsts[k + 1] : n;
        for (size_t v = first; v < end; v++)
            r.after[v] = v + 1 < end ? v + 1 : first;
    }
    for (size_t k = 0; k < n_polygons; k++) {
        size_t first = firsts[k], end = k + 1 < n_polygons ? firsts[k + 1] : n,
               n_left = end - first;
        while (go_around(&r, first, end, &n_left) > 0)
            ;
    }
    size_t kept = move_to_front(&r, points, n, firsts, n_polygons);
    free(r.after);
    free(r.first);
    free(r.next);
    return kept;
}
