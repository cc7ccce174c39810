/* A polygon with features on an integer grid, and what is wrong with it or where points lie, by
 * brute force in 64-bit integers. */
#ifndef TESTS_FEATURES_H
#define TESTS_FEATURES_H

#include "icc/icc.h"

#include "../../random.h"

#include <check.h>
#include <stdbool.h>
#include <stdint.h>

enum { MAX_FEATURES = 8, MAX_CHAIN = 8, SIDE = 24 };

typedef struct spot {
    int64_t x, y;
} spot;

/* kind 0: the outer ring */
typedef struct chain {
    int32_t kind;
    int n;
    spot at[MAX_CHAIN];
} chain;

/* Chain 0 is the outer ring, chain f + 1 is feature f. */
typedef struct picture {
    int n; /* features */
    chain chains[MAX_FEATURES + 1];
} picture;

static inline bool same(spot a, spot b)
{
    return a.x == b.x && a.y == b.y;
}

static inline int turn(spot a, spot b, spot c)
{
    const int64_t det = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    return (det > 0) - (det < 0);
}

static inline bool on(spot a, spot b, spot p)
{
    return turn(a, b, p) == 0 && (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

static inline bool is_ring(const chain *c)
{
    return c->kind != ICC_FEATURE_LINE && c->kind != ICC_FEATURE_POINT;
}

/* A point has one edge, from itself to itself. */
static inline int count_edges(const chain *c)
{
    return c->kind == ICC_FEATURE_LINE ? c->n - 1 : c->n;
}

static inline spot corner(const chain *c, int i)
{
    return c->at[i % c->n];
}

/* Closed edges, which may be points. */
static inline bool edges_meet(const chain *c, int e, const chain *d, int f)
{
    const spot p = corner(c, e), q = corner(c, e + 1), r = corner(d, f), s = corner(d, f + 1);
    if (on(p, q, r) || on(p, q, s) || on(r, s, p) || on(r, s, q))
        return true;
    return turn(p, q, r) * turn(p, q, s) < 0 && turn(r, s, p) * turn(r, s, q) < 0;
}

/* Whether q and r, both different from v, lie in the same direction from v. */
static inline bool fold(spot v, spot q, spot r)
{
    return turn(q, v, r) == 0 && (q.x - v.x) * (r.x - v.x) + (q.y - v.y) * (r.y - v.y) > 0;
}

/* Whether two edges of one or two chains have more in common than vertices, or than a whole edge
 * that both may run along. */
static inline bool edges_clash(const chain *c, int e, const chain *d, int f)
{
    const spot p = corner(c, e), q = corner(c, e + 1), r = corner(d, f), s = corner(d, f + 1);
    if (c->kind == ICC_FEATURE_POINT || d->kind == ICC_FEATURE_POINT)
        return edges_meet(c, e, d, f) && !same(p, r) && !same(p, s) && !same(q, r);
    if ((same(p, r) && same(q, s)) || (same(p, s) && same(q, r)))
        return c == d || (is_ring(c) && is_ring(d) && c->kind != ICC_FEATURE_REGION &&
                          d->kind != ICC_FEATURE_REGION);
    if (same(p, r) || same(p, s) || same(q, r) || same(q, s))
        return (same(p, r) && fold(p, q, s)) || (same(p, s) && fold(p, q, r)) ||
               (same(q, r) && fold(q, p, s)) || (same(q, s) && fold(q, p, r));
    return edges_meet(c, e, d, f);
}

static inline bool chains_clash(const chain *c, const chain *d)
{
    for (int e = 0; e < count_edges(c); ++e)
        for (int f = 0; f < count_edges(d); ++f)
            if (edges_clash(c, e, d, f))
                return true;
    return false;
}

/* A ring must not repeat a vertex at all, a line not at once. */
static inline bool clashes_with_itself(const chain *c)
{
    const int n = count_edges(c);
    if (c->kind == ICC_FEATURE_POINT)
        return false;
    for (int i = 0; i < c->n; ++i)
        for (int j = i + 1; j < c->n; ++j)
            if (same(c->at[i], c->at[j]) && (is_ring(c) || j == i + 1))
                return true;
    for (int e = 0; e < n; ++e)
        for (int f = e + 1; f < n; ++f)
            if (edges_clash(c, e, c, f))
                return true;
    return false;
}

static inline int32_t where_in_ring(const chain *ring, spot p)
{
    bool inside = false;
    for (int i = 0; i < ring->n; ++i) {
        const spot a = corner(ring, i), b = corner(ring, i + 1);
        if (on(a, b, p))
            return ICC_BOUNDARY;
        if ((a.y > p.y) != (b.y > p.y))
            inside ^= (turn(a, b, p) > 0) == (b.y > a.y);
    }
    return inside ? ICC_INSIDE : ICC_OUTSIDE;
}

static inline int64_t area_of(const chain *ring)
{
    int64_t area = 0;
    for (int i = 0; i < ring->n; ++i)
        area +=
            corner(ring, i).x * corner(ring, i + 1).y - corner(ring, i + 1).x * corner(ring, i).y;
    return area;
}

/* Whether a place just left of the middle of pq lies in a ring that does not clash with pq. For
 * p = q, whether the point lies strictly inside. */
static inline bool left_is_in(const chain *ring, spot p, spot q)
{
    chain twice = *ring;
    for (int i = 0; i < ring->n; ++i) {
        const spot a = corner(ring, i), b = corner(ring, i + 1);
        twice.at[i] = (spot){2 * a.x, 2 * a.y};
        if (same(a, p) && same(b, q))
            return area_of(ring) > 0;
        if (same(a, q) && same(b, p))
            return area_of(ring) < 0;
    }
    return where_in_ring(&twice, (spot){p.x + q.x, p.y + q.y}) == ICC_INSIDE;
}

/* In how many of the outer ring and regions the place left of pq lies, less the number of holes. */
static inline int count_left(const picture *p, spot a, spot b)
{
    int count = 0;
    for (int i = 0; i <= p->n; ++i)
        if (is_ring(&p->chains[i]) && left_is_in(&p->chains[i], a, b))
            count += p->chains[i].kind == ICC_FEATURE_HOLE ? -1 : 1;
    return count;
}

/* Whether a point is a vertex of anything that has edges. */
static inline bool is_vertex(const picture *p, spot at)
{
    for (int i = 0; i <= p->n; ++i)
        for (int k = 0; k < p->chains[i].n && p->chains[i].kind != ICC_FEATURE_POINT; ++k)
            if (same(p->chains[i].at[k], at))
                return true;
    return false;
}

/* Whether all edges and points of a chain lie in the domain or on its rim. */
static inline bool lies_in_domain(const picture *p, const chain *c)
{
    for (int e = 0; e < count_edges(c); ++e) {
        const spot a = corner(c, e), b = corner(c, e + 1);
        if (count_left(p, a, b) <= 0 && count_left(p, b, a) <= 0 &&
            !(c->kind == ICC_FEATURE_POINT && is_vertex(p, a)))
            return false;
    }
    return true;
}

static inline bool is_sound(const picture *p)
{
    for (int i = 0; i <= p->n; ++i) {
        if (clashes_with_itself(&p->chains[i]))
            return false;
        for (int j = i + 1; j <= p->n; ++j)
            if (chains_clash(&p->chains[i], &p->chains[j]))
                return false;
    }
    for (int i = 1; i <= p->n; ++i)
        if (!lies_in_domain(p, &p->chains[i]))
            return false;
    return true;
}

/* ---- pictures ---- */

static inline chain random_chain(random_source *r, int32_t kind, int centre_x, int centre_y,
                                 int spread)
{
    chain c = {.kind = kind};
    c.n = kind == ICC_FEATURE_POINT  ? 1
          : kind == ICC_FEATURE_LINE ? 2 + random_below(r, 4)
                                     : 3 + random_below(r, 3);
    for (int i = 0; i < c.n; ++i)
        c.at[i] = (spot){centre_x + random_below(r, 2 * spread + 1) - spread,
                         centre_y + random_below(r, 2 * spread + 1) - spread};
    return c;
}

/* Mostly small features in a square, or in a random ring. */
static inline void random_picture(picture *p, random_source *r)
{
    const int square[4][2] = {{0, 0}, {SIDE, 0}, {SIDE, SIDE}, {0, SIDE}};
    p->n = 1 + random_below(r, MAX_FEATURES);
    if (random_below(r, 4) == 0) {
        p->chains[0] = random_chain(r, ICC_FEATURE_HOLE, SIDE / 2, SIDE / 2, SIDE / 2);
    } else {
        p->chains[0].n = 4;
        for (int i = 0; i < 4; ++i)
            p->chains[0].at[i] = (spot){square[i][0], square[i][1]};
    }
    p->chains[0].kind = 0;
    for (int f = 0; f < p->n; ++f) {
        const int spread = 1 + random_below(r, random_below(r, 3) == 0 ? 10 : 3);
        const int margin = random_below(r, 8) == 0 ? 0 : spread + 1;
        const int room = SIDE - 2 * margin + 1;
        p->chains[f + 1] =
            random_chain(r, 1 + random_below(r, 4), margin + random_below(r, room > 0 ? room : 1),
                         margin + random_below(r, room > 0 ? room : 1), spread);
    }
}

/* ---- domains ---- */

/* What the library is asked for. `n_vertices` of `vertices`, of all chains in their order. */
typedef struct request {
    size_t n_outer, n_features, n_vertices;
    double vertices[2 * MAX_CHAIN * (MAX_FEATURES + 1)];
    icc_feature features[MAX_FEATURES];
} request;

/* Integers times `scale`, plus offsets: exactly, for the right numbers. */
static inline void request_picture(request *q, const picture *p, double scale, double x, double y)
{
    *q = (request){.n_outer = (size_t)p->chains[0].n, .n_features = (size_t)p->n};
    for (int i = 0; i <= p->n; ++i) {
        const chain *c = &p->chains[i];
        if (i > 0)
            q->features[i - 1] = (icc_feature){.size = sizeof(icc_feature),
                                               .kind = c->kind,
                                               .n_vertices = (size_t)c->n,
                                               .vertices = q->vertices + 2 * q->n_vertices};
        for (int k = 0; k < c->n; ++k) {
            q->vertices[2 * q->n_vertices] = scale * (double)c->at[k].x + x;
            q->vertices[2 * q->n_vertices++ + 1] = scale * (double)c->at[k].y + y;
        }
    }
}

static inline icc_status create(icc_domain **out, const request *q, const icc_env *env,
                                icc_error *err)
{
    *err = (icc_error){.size = sizeof *err};
    return icc_domain_create_features(out, q->n_outer, q->vertices, q->n_features, q->features, env,
                                      err);
}

#endif
