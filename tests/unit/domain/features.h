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
    return c->kind <= ICC_FEATURE_HOLE;
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

/* Two chains, or vertices or edges of one that is bad by itself. */
static inline bool chains_meet(const chain *c, const chain *d)
{
    for (int e = 0; e < count_edges(c); ++e)
        for (int f = 0; f < count_edges(d); ++f)
            if (edges_meet(c, e, d, f))
                return true;
    return false;
}

/* Whether neighbouring edges e and f, which share a vertex, have more in common. */
static inline bool fold(const chain *c, int v)
{
    const spot p = corner(c, v + c->n - 1), m = corner(c, v), q = corner(c, v + 1);
    return same(p, m) || same(m, q) ||
           (turn(p, m, q) == 0 && (p.x - m.x) * (q.x - m.x) + (p.y - m.y) * (q.y - m.y) > 0);
}

static inline bool meets_itself(const chain *c)
{
    const int n = count_edges(c);
    if (c->kind == ICC_FEATURE_POINT)
        return false;
    for (int v = is_ring(c) ? 0 : 1; v < (is_ring(c) ? c->n : c->n - 1); ++v)
        if (fold(c, v))
            return true;
    if (same(c->at[0], c->at[1]))
        return true;
    for (int e = 0; e < n; ++e)
        for (int f = e + 2; f < n; ++f)
            if (!(is_ring(c) && e == 0 && f == n - 1) && edges_meet(c, e, c, f))
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

/* Of chains that do not meet, or of points: whether the whole of c lies in the ring. */
static inline bool lies_in(const chain *c, const chain *ring)
{
    return is_ring(ring) && where_in_ring(ring, c->at[0]) == ICC_INSIDE;
}

static inline bool is_sound(const picture *p)
{
    for (int i = 0; i <= p->n; ++i) {
        if (meets_itself(&p->chains[i]))
            return false;
        for (int j = 0; j <= p->n; ++j)
            if (j != i && ((j > i && chains_meet(&p->chains[i], &p->chains[j])) ||
                           (i > 0 && lies_in(&p->chains[i], &p->chains[j]) != (j == 0))))
                return false;
    }
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
            random_chain(r, 1 + random_below(r, 3), margin + random_below(r, room > 0 ? room : 1),
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
