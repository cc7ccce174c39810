/* Based on: K. Weiler, P. Atherton, Hidden Surface Removal Using Polygon Area Sorting, 1977, for
 * two polygons whose boundaries have been cut where they meet. The pieces of the polygon inside the
 * cage are kept, and the pieces of the cage inside the polygon. A common piece is kept once if both
 * polygons are on the same side of it. */
#include "geo/clip.h"

#include "base/allocate.h"
#include "base/orientation.h"
#include "geo/clip_rings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct pieces {
    clip_piece *list;
    size_t n, room;
} pieces;

typedef struct clipper {
    noding *noding;
    geo_node *nodes; /* each place once */
    size_t n_nodes, room_nodes;
    pieces own, cage, kept;
    uint32_t *facets; /* edges of the cage close to the polygon, in their order */
    size_t n_facets;
} clipper;

static void add_piece(pieces *p, uint32_t from, uint32_t to, bool reversed)
{
    if (from == to)
        return;
    p->list = grow(p->list, &p->room, p->n + 1, sizeof *p->list);
    p->list[p->n++] = reversed ? (clip_piece){to, from, false} : (clip_piece){from, to, false};
}

static void add_node(clipper *c, const geo_node *node)
{
    c->nodes = grow(c->nodes, &c->room_nodes, c->n_nodes + 1, sizeof *c->nodes);
    c->nodes[c->n_nodes++] = *node;
}

static int by_place(const void *a, const void *b)
{
    const geo_node *p = a, *q = b;
    for (size_t k = 0; k < 2; k++)
        if (p->at[k] < q->at[k] || p->at[k] > q->at[k])
            return p->at[k] < q->at[k] ? -1 : 1;
    /* Vertices of the polygon come first, then computed places, then corners of the cage. */
    double i = p->from == SIZE_MAX ? 2 : p->along, j = q->from == SIZE_MAX ? 2 : q->along;
    return i < j ? -1 : i > j ? 1 : p->from < q->from ? -1 : p->from > q->from;
}

static bool same_place(const geo_node *a, const geo_node *b)
{
    return memcmp(a->at, b->at, sizeof a->at) == 0;
}

/* The number of a node after equal places have been united. */
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

/* Sorts the nodes and keeps one at each place. A place on the cage stays marked as such. */
static void unite_nodes(clipper *c)
{
    size_t n = 0;
    /* Turns -0 into 0. */
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

static int by_number(const void *a, const void *b)
{
    const uint32_t *p = a, *q = b;
    return *p < *q ? -1 : *p > *q;
}

/* Finds the edges of the cage close to the box of the nodes. */
static void find_facets(clipper *c)
{
    cage_grid *grid = &c->noding->grid;
    double lower[2] = {HUGE_VAL, HUGE_VAL}, upper[2] = {-HUGE_VAL, -HUGE_VAL};
    for (size_t i = 0; i < c->n_nodes; i++)
        for (size_t k = 0; k < 2; k++) {
            lower[k] = fmin(lower[k], c->nodes[i].at[k]);
            upper[k] = fmax(upper[k], c->nodes[i].at[k]);
        }
    if (c->n_nodes == 0)
        return;
    cage_grid_ask_box(grid, lower, upper);
    c->n_facets = grid->n_found;
    c->facets = need(c->n_facets, sizeof *c->facets);
    if (c->n_facets > 0) {
        memcpy(c->facets, grid->found, c->n_facets * sizeof *c->facets);
        qsort(c->facets, c->n_facets, sizeof *c->facets, by_number);
    }
}

static int by_share(const void *a, const void *b)
{
    const geo_node *p = a, *q = b;
    if (p->facet != q->facet)
        return p->facet < q->facet ? -1 : 1;
    return p->share < q->share ? -1 : p->share > q->share;
}

/* Cuts the edges of the cage close to the polygon at the nodes on them, which are sorted by
 * place. */
static void cut_cage(clipper *c, size_t n_on, const geo_node *on)
{
    const carrier *cage = c->noding->cage;
    size_t k = 0;
    for (size_t i = 0; i < c->n_facets; i++) {
        uint32_t facet = c->facets[i];
        while (k < n_on && on[k].facet < facet)
            k++;
        uint32_t last = find_node(c, cage_end(cage, facet, 0));
        for (; k < n_on && on[k].facet == facet; k++) {
            uint32_t next = find_node(c, on[k].at);
            add_piece(&c->cage, last, next, cage->reversed[facet]);
            last = next;
        }
        add_piece(&c->cage, last, find_node(c, cage_end(cage, facet, 1)), cage->reversed[facet]);
    }
}

static void add_corners(clipper *c)
{
    const carrier *cage = c->noding->cage;
    for (size_t i = 0; i < c->n_facets; i++)
        for (size_t end = 0; end < 2; end++) {
            uint32_t facet = c->facets[i];
            const double *at = cage_end(cage, facet, end);
            add_node(c, &(geo_node){.at = {at[0], at[1]},
                                    .place = GEO_ON_CAGE,
                                    .facet = facet,
                                    .share = (double)end,
                                    .from = SIZE_MAX});
        }
}

/* Finds the nodes on an edge of the cage among all that are on edges. Returns their number; *first
 * is the first one. */
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

/* Adds a piece of the polygon. A piece along an edge of the cage is cut at the same nodes as the
 * edge. */
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
    const clip_piece *p = a, *q = b;
    return p->from != q->from ? (p->from < q->from ? -1 : 1) : p->to < q->to ? -1 : p->to > q->to;
}

static clip_piece *find_piece(const pieces *p, uint32_t from, uint32_t to)
{
    clip_piece key = {from, to, false};
    return p->n > 0 ? bsearch(&key, p->list, p->n, sizeof *p->list, by_ends) : NULL;
}

/* Removes spikes: pieces of the polygon that are run through in both directions. */
static void cancel_spikes(pieces *own)
{
    size_t n = 0;
    if (own->n > 0)
        qsort(own->list, own->n, sizeof *own->list, by_ends);
    for (size_t i = 0; i < own->n; i++) {
        clip_piece *back = find_piece(own, own->list[i].to, own->list[i].from);
        if (back != NULL && !back->used && !own->list[i].used)
            back->used = own->list[i].used = true;
    }
    for (size_t i = 0; i < own->n; i++)
        if (!own->list[i].used)
            own->list[n++] = own->list[i];
    own->n = n;
}

static void middle_of(const clipper *c, const clip_piece *p, double out[2])
{
    for (size_t k = 0; k < 2; k++)
        out[k] = c->nodes[p->from].at[k] / 2 + c->nodes[p->to].at[k] / 2;
}

/* True if a ray to the right of p meets an odd number of pieces. */
static bool is_within(const clipper *c, size_t n, const clip_piece *list, const double p[2])
{
    bool odd = false;
    for (size_t i = 0; i < n; i++) {
        const double *a = c->nodes[list[i].from].at, *b = c->nodes[list[i].to].at;
        if ((a[1] > p[1]) != (b[1] > p[1]))
            odd ^= orientation(a, b, p) * (b[1] > a[1] ? 1 : -1) > 0;
    }
    return odd;
}

/* Chooses the pieces that bound the common area, as described above. */
static void keep(clipper *c)
{
    double middle[2];
    if (c->cage.n > 0)
        qsort(c->cage.list, c->cage.n, sizeof *c->cage.list, by_ends);
    for (size_t i = 0; i < c->own.n; i++) {
        const clip_piece *own = &c->own.list[i];
        clip_piece *same = find_piece(&c->cage, own->from, own->to);
        clip_piece *opposite = find_piece(&c->cage, own->to, own->from);
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

/* Collects the nodes of the rings, ring after ring, and finds the edges of the cage close to them.
 * Returns where each ring begins. */
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
    find_facets(c);
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
    bool good = clip_rings(out, c.n_nodes, c.nodes, c.kept.n, c.kept.list);
    free(starts);
    free(all);
    free(on);
    free(c.nodes);
    free(c.facets);
    free(c.own.list);
    free(c.cage.list);
    free(c.kept.list);
    return good;
}
