/* Walks along the cage with the outside on the left. Where several edges leave a vertex, the walk
 * takes the next one clockwise, so that it stays at one piece of the outside. Each lake has one
 * walk whose lowest corner opens upwards. The walks round islands and round the whole cage have
 * their outside below.
 *
 * Let v be the lowest corner of a lake, and a and b its neighbours. If no vertex of the cage lies
 * in the triangle a v b, its centre is in the lake. Otherwise take the vertex in the triangle that
 * is farthest from the line a b. The middle between this vertex and v is in the lake, because
 * nothing lies between the two (J. O'Rourke, Computational Geometry in C, 1.5). */
#include "geo/lakes.h"

#include "base/allocate.h"
#include "base/orientation.h"

#include <math.h>
#include <stdlib.h>

/* An edge of the cage in the direction that has the outside on its left. */
typedef struct shore {
    const double *from, *to;
    bool done;
} shore;

/* By height, then from left to right. */
static int by_place(const double *p, const double *q)
{
    return p[1] < q[1] ? -1 : p[1] > q[1] ? 1 : (p[0] > q[0]) - (p[0] < q[0]);
}

static int by_begin(const void *a, const void *b)
{
    return by_place(((const shore *)a)->from, ((const shore *)b)->from);
}

static shore *list_shores(const carrier *cage)
{
    shore *s = need(cage->n_facets, sizeof *s);
    for (size_t i = 0; i < cage->n_facets; i++) {
        bool against = !cage->reversed[i];
        const uint32_t *ends = cage->facets[0] + 2 * i;
        s[i].from = cage->vertices[0] + 2 * (size_t)ends[against];
        s[i].to = cage->vertices[0] + 2 * (size_t)ends[!against];
    }
    qsort(s, cage->n_facets, sizeof *s, by_begin);
    return s;
}

/* Returns the first shore that leaves a place. */
static size_t first_from(const shore *s, size_t n, const double *place)
{
    size_t low = 0, high = n;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (by_place(s[middle].from, place) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Ranks the clockwise angle from v r to v p: 1 below half a turn, 2 for half a turn, 3 above it, 4
 * for a whole turn. */
static int clockwise(const double *v, const double *r, const double *p)
{
    int turn = orientation(v, r, p);
    return turn < 0 ? 1 : turn > 0 ? 3 : by_place(r, p) == 0 ? 4 : 2;
}

/* Returns the shore on which a walk goes on: clockwise the first one after the way back. */
static size_t next_of(const shore *s, size_t n, size_t i)
{
    const double *v = s[i].to, *back = s[i].from;
    size_t best = first_from(s, n, v);
    for (size_t k = best + 1; k < n && by_place(s[k].from, v) == 0; k++) {
        int angle = clockwise(v, back, s[k].to), least = clockwise(v, back, s[best].to);
        if (angle < least || (angle == least && orientation(v, s[best].to, s[k].to) > 0))
            best = k;
    }
    return best;
}

/* Adds a point in the lake whose lowest corner is v, between its neighbours a and b. */
static void add_lake(lakes *out, const shore *s, size_t n, const double *a, const double *v,
                     const double *b)
{
    double left = fmin(v[0], fmin(a[0], b[0])), right = fmax(v[0], fmax(a[0], b[0]));
    double top = fmax(a[1], b[1]), most = 0;
    const double *inner = NULL;
    for (size_t i = first_from(s, n, v); i < n && s[i].from[1] <= top; i++) {
        const double *p = s[i].from;
        if (p[0] < left || p[0] > right || by_place(p, a) == 0 || by_place(p, b) == 0 ||
            by_place(p, v) == 0 || orientation(a, v, p) < 0 || orientation(v, b, p) < 0 ||
            orientation(b, a, p) < 0)
            continue;
        double height = fabs((b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]));
        if (inner == NULL || height > most) {
            inner = p;
            most = height;
        }
    }
    out->points = grow(out->points, &out->room, out->n + 1, 2 * sizeof *out->points);
    for (size_t k = 0; k < 2; k++)
        out->points[2 * out->n + k] =
            inner != NULL ? v[k] / 2 + inner[k] / 2 : a[k] / 3 + v[k] / 3 + b[k] / 3;
    out->n++;
}

/* Walks from a shore until it comes back, and adds the lake if it is one. */
static void walk(lakes *out, shore *s, size_t n, size_t from)
{
    const shore *low = NULL, *after = NULL;
    bool opens_upwards = false;
    for (size_t i = from, next; !s[i].done; i = next) {
        next = next_of(s, n, i);
        s[i].done = true;
        int order = low == NULL ? -1 : by_place(s[i].to, low->to);
        if (order > 0)
            continue;
        /* A walk that passes its lowest corner twice must open upwards both times. */
        bool turns_left = orientation(s[i].from, s[i].to, s[next].to) > 0;
        opens_upwards = turns_left && (order < 0 || opens_upwards);
        low = &s[i];
        after = &s[next];
    }
    if (opens_upwards)
        add_lake(out, s, n, low->from, low->to, after->to);
}

void lakes_find(lakes *out, const carrier *cage)
{
    *out = (lakes){0};
    shore *s = list_shores(cage);
    for (size_t i = 0; i < cage->n_facets; i++)
        walk(out, s, cage->n_facets, i);
    free(s);
}

void lakes_free(lakes *l)
{
    free(l->points);
    *l = (lakes){0};
}
