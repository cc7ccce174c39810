/* A vertex moves along the bisector of its two sides. What lies across a gap is found among the
 * sides that come near the vertex. Sides are looked up by strips of the plane. */
#include "cage/grow_polygons.h"

#include "base/allocate.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* SHARPEST: at a corner a vertex moves farther than its sides, at most by this factor. ACROSS: it
 * takes one of so many equal steps to what lies across a gap. */
static const double SHARPEST = 2, ACROSS = 3;

typedef struct strips {
    const double *points;
    size_t *before, *after; /* the neighbours of each vertex */
    double low, height;     /* where the first strip begins, and the height of each */
    size_t n, *first;       /* n + 1 */
    size_t *sides;          /* by the vertex where they begin; strip k has those from first[k] on */
} strips;

static const double *at(const strips *s, size_t v)
{
    return s->points + 2 * v;
}

static size_t strip_of(const strips *s, double y)
{
    double k = floor((y - s->low) / s->height);
    return k <= 0 ? 0 : k >= (double)(s->n - 1) ? s->n - 1 : (size_t)k;
}

/* Counts the sides of each strip, or lists them. */
static void go_through_sides(strips *s, size_t n, bool lists)
{
    for (size_t v = 0; v < n; v++) {
        double a = at(s, v)[1], b = at(s, s->after[v])[1];
        size_t last = strip_of(s, fmax(a, b));
        for (size_t k = strip_of(s, fmin(a, b)); k <= last; k++) {
            if (lists)
                s->sides[--s->first[k]] = v;
            else
                s->first[k]++;
        }
    }
}

static void make_strips(strips *s, size_t n, double height)
{
    double high = -HUGE_VAL;
    s->low = HUGE_VAL;
    for (size_t v = 0; v < n; v++) {
        s->low = fmin(s->low, at(s, v)[1]);
        high = fmax(high, at(s, v)[1]);
    }
    s->height = height;
    s->n = (size_t)((high - s->low) / height) + 1;
    s->first = need(s->n + 1, sizeof *s->first);
    go_through_sides(s, n, false);
    for (size_t k = 1; k <= s->n; k++)
        s->first[k] += s->first[k - 1];
    s->sides = need(s->first[s->n], sizeof *s->sides);
    go_through_sides(s, n, true);
}

static void link_polygons(strips *s, size_t n, const size_t *firsts, size_t n_polygons)
{
    s->before = need(n, sizeof *s->before);
    s->after = need(n, sizeof *s->after);
    for (size_t k = 0; k < n_polygons; k++) {
        size_t first = firsts[k], end = k + 1 < n_polygons ? firsts[k + 1] : n;
        for (size_t v = first; v < end; v++) {
            s->before[v] = v > first ? v - 1 : end - 1;
            s->after[v] = v + 1 < end ? v + 1 : first;
        }
    }
}

/* The outward normal of a side. */
static void find_normal(const double *a, const double *b, double out[2])
{
    double length = hypot(b[0] - a[0], b[1] - a[1]);
    out[0] = (a[1] - b[1]) / length;
    out[1] = (b[0] - a[0]) / length;
}

/* The direction in which a vertex moves, and how far if its sides move by 1. */
static double find_direction(const strips *s, size_t v, double out[2])
{
    double normals[2][2];
    find_normal(at(s, s->before[v]), at(s, v), normals[0]);
    find_normal(at(s, v), at(s, s->after[v]), normals[1]);
    double x = normals[0][0] + normals[1][0], y = normals[0][1] + normals[1][1],
           length = hypot(x, y);
    if (!(length > 0)) { /* the polygon turns back */
        memcpy(out, normals[0], 2 * sizeof *out);
        return 1;
    }
    out[0] = x / length;
    out[1] = y / length;
    return fmin(2 / length, SHARPEST);
}

/* Shortens a step of a vertex if a side lies ahead of it. */
static double step_before(const strips *s, size_t v, size_t side, const double *direction,
                          double step)
{
    const double *p = at(s, v), *a = at(s, side), *b = at(s, s->after[side]);
    double u[2] = {b[0] - a[0], b[1] - a[1]};
    double along = ((p[0] - a[0]) * u[0] + (p[1] - a[1]) * u[1]) / (u[0] * u[0] + u[1] * u[1]);
    along = fmin(fmax(along, 0), 1);
    double to[2] = {a[0] + along * u[0] - p[0], a[1] + along * u[1] - p[1]};
    double distance = hypot(to[0], to[1]);
    bool ahead = to[0] * direction[0] + to[1] * direction[1] > distance / 2;
    return ahead ? fmin(step, distance / ACROSS) : step;
}

static double find_step(const strips *s, size_t v, const double *direction, double step)
{
    double reach = ACROSS * step;
    size_t last = strip_of(s, at(s, v)[1] + reach);
    for (size_t k = strip_of(s, at(s, v)[1] - reach); k <= last; k++)
        for (size_t i = s->first[k]; i < s->first[k + 1]; i++)
            if (s->sides[i] != v && s->sides[i] != s->before[v])
                step = step_before(s, v, s->sides[i], direction, step);
    return step;
}

/* Shortens a step so that it stays in the box. */
static double step_in_box(const double *p, const double *direction, double step, const double *box)
{
    for (size_t k = 0; k < 2; k++) {
        double room = direction[k] > 0 ? box[k] - p[k] : p[k];
        if (fabs(direction[k]) * step > room)
            step = fmax(room, 0) / fabs(direction[k]);
    }
    return step;
}

void grow_polygons(double *points, size_t n, const size_t *firsts, size_t n_polygons,
                   double distance, const double box[2])
{
    if (n == 0 || !(distance > 0))
        return;
    strips s = {.points = points};
    double *grown = need(n, 2 * sizeof *grown);
    link_polygons(&s, n, firsts, n_polygons);
    make_strips(&s, n, ACROSS * SHARPEST * distance);
    for (size_t v = 0; v < n; v++) {
        double direction[2];
        double step = distance * find_direction(&s, v, direction);
        step = step_in_box(at(&s, v), direction, find_step(&s, v, direction, step), box);
        for (size_t k = 0; k < 2; k++)
            grown[2 * v + k] = at(&s, v)[k] + step * direction[k];
    }
    memcpy(points, grown, n * 2 * sizeof *points);
    free(grown);
    free(s.before);
    free(s.after);
    free(s.first);
    free(s.sides);
}
