/* As many kept pieces end at each node as start there, so they form rings. This fails only if the
 * polygon crosses itself or rounding has moved a piece. */
#include "geo/clip_rings.h"

#include "base/allocate.h"
#include "base/orientation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct tracer {
    size_t n_nodes, n_pieces;
    const geo_node *nodes;
    clip_piece *pieces;
    uint32_t *starts; /* of the nodes in the pieces */
} tracer;

double ring_area(size_t n, const double *points, size_t stride)
{
    double sum = 0;
    for (size_t i = 1; i + 1 < n; i++) {
        const double *a = points, *b = points + stride * i, *c = points + stride * (i + 1);
        sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    return sum;
}

/* Finds where the pieces from each node begin. False if at some node the numbers of pieces in and
 * out differ. */
static bool balance(tracer *c)
{
    uint32_t *into = need(c->n_nodes + 1, sizeof *into);
    bool good = true;
    c->starts = need(c->n_nodes + 1, sizeof *c->starts);
    for (size_t i = 0; i < c->n_pieces; i++) {
        c->starts[c->pieces[i].from + 1]++;
        into[c->pieces[i].to]++;
    }
    for (size_t i = 0; i < c->n_nodes; i++) {
        good = good && c->starts[i + 1] == into[i];
        c->starts[i + 1] += c->starts[i];
    }
    free(into);
    return good;
}

/* The angle by which b is turned clockwise from a, in full turns: 0 < turn <= 1. */
static double clockwise(const double a[2], const double b[2])
{
    const double full = 6.283185307179586;
    double turn = (atan2(a[1], a[0]) - atan2(b[1], b[0])) / full;
    return turn > 0 ? turn : turn + 1;
}

/* The next piece along the same face: of those that leave the node, the first one clockwise from
 * the piece that came in. */
static clip_piece *next_piece(const tracer *c, const clip_piece *p, const clip_piece *start)
{
    const double *at = c->nodes[p->to].at, *from = c->nodes[p->from].at;
    double back[2] = {from[0] - at[0], from[1] - at[1]}, best = 2;
    clip_piece *next = NULL;
    for (uint32_t i = c->starts[p->to]; i < c->starts[p->to + 1]; i++) {
        clip_piece *q = &c->pieces[i];
        const double *to = c->nodes[q->to].at;
        double turn = clockwise(back, (double[2]){to[0] - at[0], to[1] - at[1]});
        if ((!q->used || q == start) && turn < best) {
            best = turn;
            next = q;
        }
    }
    return next;
}

static void add_ring(tracer *c, clipped *out, size_t n, const uint32_t *ring)
{
    if (n < 3)
        return;
    clip_ring *r = &out->rings[out->n_rings];
    *r = (clip_ring){out->n_nodes, n, 0};
    for (size_t i = 0; i < n; i++)
        out->nodes[out->n_nodes + i] = c->nodes[ring[i]];
    double area = ring_area(n, out->nodes[r->first].at, sizeof(geo_node) / sizeof(double));
    if (area < 0 || area > 0) {
        out->n_nodes += n;
        out->n_rings++;
    }
}

/* Follows the pieces around. A ring that returns to a node before its end is split there, so that
 * each ring is simple. */
static bool trace_rings(tracer *c, clipped *out)
{
    size_t n = 0;
    uint32_t *stack = need(c->n_pieces + 1, sizeof *stack), *at = need(c->n_nodes, sizeof *at);
    bool good = true;
    out->nodes = need(c->n_pieces, sizeof *out->nodes);
    out->rings = need(c->n_pieces, sizeof *out->rings);
    memset(at, 0xff, c->n_nodes * sizeof *at);
    for (size_t i = 0; i < c->n_pieces && good; i++) {
        clip_piece *start = &c->pieces[i], *p = start;
        if (p->used)
            continue;
        do {
            p->used = true;
            at[p->from] = (uint32_t)n;
            stack[n++] = p->from;
            if (at[p->to] != GEO_NOWHERE) {
                size_t first = at[p->to];
                add_ring(c, out, n - first, stack + first);
                while (n > first)
                    at[stack[--n]] = GEO_NOWHERE;
            }
            p = next_piece(c, p, start);
        } while (p != NULL && p != start);
        good = p == start && n == 0;
    }
    free(stack);
    free(at);
    return good;
}

static bool ring_holds(const clipped *r, const clip_ring *ring, const double p[2])
{
    bool odd = false;
    for (size_t i = 0; i < ring->n; i++) {
        const double *a = r->nodes[ring->first + i].at;
        const double *b = r->nodes[ring->first + (i + 1) % ring->n].at;
        if ((a[1] > p[1]) != (b[1] > p[1]))
            odd ^= orientation(a, b, p) * (b[1] > a[1] ? 1 : -1) > 0;
    }
    return odd;
}

static double area_of(const clipped *r, const clip_ring *ring)
{
    return ring_area(ring->n, r->nodes[ring->first].at, sizeof(geo_node) / sizeof(double));
}

static int by_part(const void *a, const void *b)
{
    const clip_ring *p = a, *q = b;
    return p->part != q->part    ? (p->part < q->part ? -1 : 1)
           : p->first < q->first ? -1
                                 : p->first > q->first;
}

/* Gives each hole to the smallest ring around it, and sorts the rings. */
static bool assign_holes(clipped *r)
{
    size_t n_parts = 0;
    for (size_t i = 0; i < r->n_rings; i++)
        r->rings[i].part = area_of(r, &r->rings[i]) > 0 ? 2 * n_parts++ : SIZE_MAX;
    for (size_t i = 0; i < r->n_rings; i++) {
        clip_ring *hole = &r->rings[i];
        double best = HUGE_VAL, middle[2];
        const double *a = r->nodes[hole->first].at, *b = r->nodes[hole->first + 1].at;
        if (hole->part != SIZE_MAX)
            continue;
        for (size_t k = 0; k < 2; k++)
            middle[k] = a[k] / 2 + b[k] / 2;
        for (size_t k = 0; k < r->n_rings; k++) {
            const clip_ring *outer = &r->rings[k];
            double area = area_of(r, outer);
            if (area > 0 && area < best && ring_holds(r, outer, middle)) {
                best = area;
                hole->part = outer->part + 1;
            }
        }
        if (hole->part == SIZE_MAX)
            return false;
    }
    qsort(r->rings, r->n_rings, sizeof *r->rings, by_part);
    for (size_t i = 0; i < r->n_rings; i++)
        r->rings[i].part /= 2;
    r->n_parts = n_parts;
    return true;
}

bool clip_rings(clipped *out, size_t n_nodes, const geo_node *nodes, size_t n, clip_piece *pieces)
{
    tracer c = {.n_nodes = n_nodes, .n_pieces = n, .nodes = nodes, .pieces = pieces};
    bool good = balance(&c) && trace_rings(&c, out) && assign_holes(out);
    free(c.starts);
    return good;
}

void clipped_free(clipped *c)
{
    free(c->nodes);
    free(c->rings);
    *c = (clipped){0};
}
