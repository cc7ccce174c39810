/* Based on: K. Weiler, P. Atherton, Hidden Surface Removal Using Polygon Area Sorting, 1977, for two polygons whose
 * boundaries have been cut where they meet. Of the polygon's pieces those in the cage are kept, of the cage's those
 * in the polygon; a piece that both have is kept once if they are on the same side of it. What is kept has as many
 * pieces into each node as out of it, unless the polygon crosses itself or rounding has misplaced a piece,
 * and then falls into rings. */
#include "geo/clip.h"

#include "base/allocate.h"
#include "base/orientation.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* From node to node, with the inside on the left. */
typedef struct piece {
    uint32_t from, to;
    bool used;
} piece;

typedef struct pieces {
    piece *list;
    size_t n, room;
} pieces;

typedef struct clipper {
    noding *noding;
    geo_node *nodes; /* each place once */
    size_t n_nodes, room_nodes;
    pieces own, cage, kept;
    double lower[2], upper[2];
    uint32_t *starts; /* of the nodes in `kept` */
} clipper;

double ring_area(size_t n, const double *points, size_t stride)
{
    double sum = 0;
    for (size_t i = 1; i + 1 < n; i++) {
        const double *a = points, *b = points + stride * i, *c = points + stride * (i + 1);
        sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    }
    return sum;
}

static void add_piece(pieces *p, uint32_t from, uint32_t to, bool reversed)
{
    if (from == to)
        return;
    p->list = grow(p->list, &p->room, p->n + 1, sizeof *p->list);
    p->list[p->n++] = reversed ? (piece){to, from, false} : (piece){from, to, false};
}

static void add_node(clipper *c, const geo_node *node)
{
    c->nodes = grow(c->nodes, &c->room_nodes, c->n_nodes + 1, sizeof *c->nodes);
    c->nodes[c->n_nodes++] = *node;
}

/* ---- the nodes ---- */

static int by_place(const void *a, const void *b)
{
    const geo_node *p = a, *q = b;
    for (size_t k = 0; k < 2; k++)
        if (p->at[k] < q->at[k] || p->at[k] > q->at[k])
            return p->at[k] < q->at[k] ? -1 : 1;
    /* Vertices of the polygon come before what was computed, and that before corners of the cage. */
    double i = p->from == SIZE_MAX ? 2 : p->along, j = q->from == SIZE_MAX ? 2 : q->along;
    return i < j ? -1 : i > j ? 1 : p->from < q->from ? -1 : p->from > q->from;
}

static bool same_place(const geo_node *a, const geo_node *b)
{
    return memcmp(a->at, b->at, sizeof a->at) == 0;
}

/* Where a node has come to among those that are kept once each. */
static uint32_t find_node(const clipper *c, const double at[2])
{
    size_t low = 0, high = c->n_nodes;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        const double *m = c->nodes[middle].at;
        bool below = m[0] < at[0] || (m[0] <= at[0] && m[1] <= at[1]);
        low = below ? middle : low;
        high = below ? high : middle;
    }
    return (uint32_t)low;
}

static void unite_nodes(clipper *c)
{
    size_t n = 0;
    /* Minus zero is zero. */
    for (size_t i = 0; i < c->n_nodes; i++)
        for (size_t k = 0; k < 2; k++)
            c->nodes[i].at[k] += 0.0;
    if (c->n_nodes > 0)
        qsort(c->nodes, c->n_nodes, sizeof *c->nodes, by_place);
    for (size_t i = 0; i < c->n_nodes; i++) {
        if (n > 0 && same_place(&c->nodes[n - 1], &c->nodes[i])) {
            geo_node *kept = &c->nodes[n - 1];
            if (kept->place != GEO_ON_CAGE && c->nodes[i].place == GEO_ON_CAGE) {
                kept->place = GEO_ON_CAGE;
                kept->facet = c->nodes[i].facet;
                kept->share = c->nodes[i].share;
            }
        } else
            c->nodes[n++] = c->nodes[i];
    }
    c->n_nodes = n;
}

/* ---- the pieces ---- */

static bool meets_box(const clipper *c, uint32_t facet)
{
    const double *a = cage_end(c->noding->cage, facet, 0), *b = cage_end(c->noding->cage, facet, 1);
    for (size_t k = 0; k < 2; k++)
        if (fmax(a[k], b[k]) < c->lower[k] || fmin(a[k], b[k]) > c->upper[k])
            return false;
    return true;
}

static int by_share(const void *a, const void *b)
{
    const geo_node *p = a, *q = b;
    if (p->facet != q->facet)
        return p->facet < q->facet ? -1 : 1;
    return p->share < q->share ? -1 : p->share > q->share;
}

/* The edges of the cage near the polygon, cut at the nodes on them, which are sorted by place. */
static void cut_cage(clipper *c, size_t n_on, const geo_node *on)
{
    const carrier *cage = c->noding->cage;
    size_t k = 0;
    for (uint32_t facet = 0; facet < cage->n_facets; facet++) {
        if (!meets_box(c, facet))
            continue;
        while (k < n_on && on[k].facet < facet)
            k++;
        uint32_t last = find_node(c, cage_end(cage, facet, 0));
        for (; k < n_on && on[k].facet == facet; k++) {
            uint32_t next = find_node(c, on[k].at);
            add_piece(&c->cage, last, next, cage->orientation < 0);
            last = next;
        }
        add_piece(&c->cage, last, find_node(c, cage_end(cage, facet, 1)), cage->orientation < 0);
    }
}

static void add_corners(clipper *c)
{
    const carrier *cage = c->noding->cage;
    for (uint32_t facet = 0; facet < cage->n_facets; facet++)
        for (size_t end = 0; end < 2 && meets_box(c, facet); end++) {
            const double *at = cage_end(cage, facet, end);
            add_node(c, &(geo_node){.at = {at[0], at[1]},
                                    .place = GEO_ON_CAGE,
                                    .facet = facet,
                                    .share = (double)end,
                                    .from = SIZE_MAX});
        }
}

/* The nodes on an edge of the cage among all that are on edges; how many, and which is the first. */
static size_t nodes_of(size_t n_on, const geo_node *on, uint32_t facet, size_t *first)
{
    size_t low = 0, high = n_on;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (on[middle].facet < facet)
            low = middle + 1;
        else
            high = middle;
    }
    for (*first = low; low < n_on && on[low].facet == facet;)
        low++;
    return low - *first;
}

/* Adds a piece of the polygon. One that runs along an edge of the cage is cut at whatever nodes there are on it, as
 * the edge is. */
static void add_own(clipper *c, const geo_node *a, const geo_node *b, bool reversed, size_t n_on,
                    const geo_node *on)
{
    uint32_t last = find_node(c, a->at), end = find_node(c, b->at), facet = GEO_NOWHERE;
    double from = 0, to = 0;
    if (a->place == GEO_ON_CAGE && b->place == GEO_ON_CAGE)
        facet = noding_common_edge(c->noding, a->at, b->at, &from, &to);
    size_t first = 0, n = 0;
    if (facet != GEO_NOWHERE)
        n = nodes_of(n_on, on, facet, &first);
    for (size_t i = 0; i < n; i++) {
        const geo_node *node = &on[from < to ? first + i : first + n - 1 - i];
        if (node->share > fmin(from, to) && node->share < fmax(from, to)) {
            uint32_t next = find_node(c, node->at);
            add_piece(&c->own, last, next, reversed);
            last = next;
        }
    }
    add_piece(&c->own, last, end, reversed);
}

static int by_ends(const void *a, const void *b)
{
    const piece *p = a, *q = b;
    return p->from != q->from ? (p->from < q->from ? -1 : 1) : p->to < q->to ? -1 : p->to > q->to;
}

static piece *find_piece(const pieces *p, uint32_t from, uint32_t to)
{
    piece key = {from, to, false};
    return p->n > 0 ? bsearch(&key, p->list, p->n, sizeof *p->list, by_ends) : NULL;
}

/* Takes out spikes: pieces of the polygon that are gone along there and back. */
static void cancel_spikes(pieces *own)
{
    size_t n = 0;
    if (own->n > 0)
        qsort(own->list, own->n, sizeof *own->list, by_ends);
    for (size_t i = 0; i < own->n; i++) {
        piece *back = find_piece(own, own->list[i].to, own->list[i].from);
        if (back != NULL && !back->used && !own->list[i].used)
            back->used = own->list[i].used = true;
    }
    for (size_t i = 0; i < own->n; i++)
        if (!own->list[i].used)
            own->list[n++] = own->list[i];
    own->n = n;
}

static void middle_of(const clipper *c, const piece *p, double out[2])
{
    for (size_t k = 0; k < 2; k++)
        out[k] = c->nodes[p->from].at[k] / 2 + c->nodes[p->to].at[k] / 2;
}

/* Whether a ray to the right of p meets an odd number of pieces. */
static bool is_within(const clipper *c, size_t n, const piece *list, const double p[2])
{
    bool odd = false;
    for (size_t i = 0; i < n; i++) {
        const double *a = c->nodes[list[i].from].at, *b = c->nodes[list[i].to].at;
        if ((a[1] > p[1]) != (b[1] > p[1]))
            odd ^= orientation(a, b, p) * (b[1] > a[1] ? 1 : -1) > 0;
    }
    return odd;
}

static void keep(clipper *c)
{
    double middle[2];
    if (c->cage.n > 0)
        qsort(c->cage.list, c->cage.n, sizeof *c->cage.list, by_ends);
    for (size_t i = 0; i < c->own.n; i++) {
        const piece *own = &c->own.list[i];
        piece *same = find_piece(&c->cage, own->from, own->to);
        piece *opposite = find_piece(&c->cage, own->to, own->from);
        const geo_node *a = &c->nodes[own->from], *b = &c->nodes[own->to];
        bool kept = same != NULL;
        if (same != NULL || opposite != NULL)
            (same != NULL ? same : opposite)->used = true;
        else if (a->place != GEO_ON_CAGE || b->place != GEO_ON_CAGE)
            kept = (a->place != GEO_ON_CAGE ? a : b)->place == GEO_INSIDE;
        else {
            middle_of(c, own, middle);
            kept = !noding_is_outside(c->noding, middle, 0);
        }
        if (kept)
            add_piece(&c->kept, own->from, own->to, false);
    }
    for (size_t i = 0; i < c->cage.n; i++) {
        middle_of(c, &c->cage.list[i], middle);
        if (!c->cage.list[i].used && is_within(c, c->own.n, c->own.list, middle))
            add_piece(&c->kept, c->cage.list[i].from, c->cage.list[i].to, false);
    }
    if (c->kept.n > 0)
        qsort(c->kept.list, c->kept.n, sizeof *c->kept.list, by_ends);
}

/* ---- the rings ---- */

/* Where the pieces from each node begin. False: into some node there come more or fewer than go out. */
static bool balance(clipper *c)
{
    uint32_t *into = need(c->n_nodes + 1, sizeof *into);
    bool good = true;
    c->starts = need(c->n_nodes + 1, sizeof *c->starts);
    for (size_t i = 0; i < c->kept.n; i++) {
        c->starts[c->kept.list[i].from + 1]++;
        into[c->kept.list[i].to]++;
    }
    for (size_t i = 0; i < c->n_nodes; i++) {
        good = good && c->starts[i + 1] == into[i];
        c->starts[i + 1] += c->starts[i];
    }
    free(into);
    return good;
}

/* How far b is turned clockwise from a, in full turns: 0 < turn <= 1. */
static double clockwise(const double a[2], const double b[2])
{
    const double full = 6.283185307179586;
    double turn = (atan2(a[1], a[0]) - atan2(b[1], b[0])) / full;
    return turn > 0 ? turn : turn + 1;
}

/* The piece that goes on along the same face: of those that leave the node the first clockwise from where we come
 * from. */
static piece *next_piece(const clipper *c, const piece *p, const piece *start)
{
    const double *at = c->nodes[p->to].at, *from = c->nodes[p->from].at;
    double back[2] = {from[0] - at[0], from[1] - at[1]}, best = 2;
    piece *next = NULL;
    for (uint32_t i = c->starts[p->to]; i < c->starts[p->to + 1]; i++) {
        piece *q = &c->kept.list[i];
        const double *to = c->nodes[q->to].at;
        double turn = clockwise(back, (double[2]){to[0] - at[0], to[1] - at[1]});
        if ((!q->used || q == start) && turn < best) {
            best = turn;
            next = q;
        }
    }
    return next;
}

static void add_ring(clipper *c, clipped *out, size_t n, const uint32_t *ring)
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

/* Follows the pieces round. A ring that comes back to a node before its end is split there, so that each is
 * simple. */
static bool trace_rings(clipper *c, clipped *out)
{
    size_t n = 0;
    uint32_t *stack = need(c->kept.n + 1, sizeof *stack), *at = need(c->n_nodes, sizeof *at);
    bool good = true;
    out->nodes = need(c->kept.n, sizeof *out->nodes);
    out->rings = need(c->kept.n, sizeof *out->rings);
    memset(at, 0xff, c->n_nodes * sizeof *at);
    for (size_t i = 0; i < c->kept.n && good; i++) {
        piece *start = &c->kept.list[i], *p = start;
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

/* The nodes of the rings, each ring behind the other, with where they begin; false if one is not in order. */
static size_t *collect(clipper *c, const geo_shape *shape, size_t first, size_t n_rings,
                       const icc_status *status, const bool *snapped)
{
    size_t *starts = need(n_rings + 1, sizeof *starts);
    for (size_t r = 0; r < n_rings; r++) {
        noding_path(c->noding, shape, first + r, status, snapped);
        for (size_t i = 0; i < c->noding->n; i++)
            add_node(c, &c->noding->nodes[i]);
        starts[r + 1] = c->n_nodes;
    }
    for (size_t k = 0; k < 2; k++) {
        c->lower[k] = HUGE_VAL;
        c->upper[k] = -HUGE_VAL;
        for (size_t i = 0; i < c->n_nodes; i++) {
            c->lower[k] = fmin(c->lower[k], c->nodes[i].at[k]);
            c->upper[k] = fmax(c->upper[k], c->nodes[i].at[k]);
        }
    }
    return starts;
}

bool clip_polygon(clipped *out, noding *x, const geo_shape *shape, size_t first, size_t n_rings,
                  const icc_status *status, const bool *snapped)
{
    clipper c = {.noding = x};
    *out = (clipped){0};
    size_t *starts = collect(&c, shape, first, n_rings, status, snapped);
    size_t n = c.n_nodes, n_on = 0;
    geo_node *all = need(n, sizeof *all), *on = need(n, sizeof *on);
    if (n > 0)
        memcpy(all, c.nodes, n * sizeof *all);
    for (size_t i = 0; i < n; i++)
        if (all[i].place == GEO_ON_CAGE && all[i].share > 0 && all[i].share < 1)
            on[n_on++] = all[i];
    qsort(on, n_on, sizeof *on, by_share);
    add_corners(&c);
    unite_nodes(&c);
    for (size_t r = 0; r < n_rings; r++) {
        size_t begin = starts[r], n_own = starts[r + 1] - begin;
        double area = n_own > 0 ? ring_area(n_own, all[begin].at, sizeof *all / sizeof(double)) : 0;
        for (size_t i = 0; i < n_own; i++)
            add_own(&c, &all[begin + i], &all[begin + (i + 1) % n_own], (r == 0) != (area > 0),
                    n_on, on);
    }
    cancel_spikes(&c.own);
    cut_cage(&c, n_on, on);
    keep(&c);
    bool good = balance(&c) && trace_rings(&c, out) && assign_holes(out);
    free(starts);
    free(all);
    free(on);
    free(c.nodes);
    free(c.own.list);
    free(c.cage.list);
    free(c.kept.list);
    free(c.starts);
    return good;
}

void clipped_free(clipped *c)
{
    free(c->nodes);
    free(c->rings);
    *c = (clipped){0};
}
