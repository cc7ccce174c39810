/* An edge that the mesh lacks crosses faces of it. Flips that lower their number come first. When
 * there is none, a point is put on the edge, where it crosses a face or an edge: as near to there
 * as it takes to see, exactly, all of the two tetrahedra or the ring there. No edge is lost by
 * that, and the two pieces cross fewer faces than the edge did; so the points are finitely many. */
#include "fill/segments.h"

#include "base/error.h"
#include "fill/fixed.h"
#include "fill/flip.h"
#include "fill/insert.h"

#include <math.h>

/* How the way from a to b meets a triangle. */
enum { MISSES, THROUGH, AT_EDGE, WITHIN };

typedef struct way {
    iccp_tets *m;
    iccp_surface *s;
    uint32_t a, b;
    iccp_list tets, crossed; /* crossed: sides */
    uint32_t p, q;           /* the edge that is being removed */
    size_t most_points;
} way;

static bool has(const uint32_t x[3], uint32_t p)
{
    return x[0] == p || x[1] == p || x[2] == p;
}

/* In the plane of x, which looks counter-clockwise from d. */
static int meets_within(const way *w, const uint32_t x[3], uint32_t d)
{
    const bool has_a = has(x, w->a), has_b = has(x, w->b);
    if (has_a && has_b)
        return MISSES;
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
        const uint32_t u = x[i], v = x[(i + 1) % 3];
        const int of_a = iccp_tets_orient(w->m, u, v, w->a, d);
        const int of_b = iccp_tets_orient(w->m, u, v, w->b, d);
        if (of_a <= 0 && of_b <= 0)
            return MISSES;
        const int side = iccp_tets_orient(w->m, w->a, w->b, u, d);
        left += side > 0;
        right += side < 0;
    }
    return left == 3 || right == 3 ? MISSES : WITHIN;
}

/* Where d is unknown, as ICCP_NO_TET, all that lies in the plane is taken to be met. */
static int meets(const way *w, const uint32_t x[3], uint32_t d)
{
    const int of_a = has(x, w->a) ? 0 : iccp_tets_orient(w->m, x[0], x[1], x[2], w->a);
    const int of_b = has(x, w->b) ? 0 : iccp_tets_orient(w->m, x[0], x[1], x[2], w->b);
    if (of_a == 0 && of_b == 0) {
        if (d != ICCP_NO_TET)
            return meets_within(w, x, d);
        return has(x, w->a) && has(x, w->b) ? MISSES : WITHIN;
    }
    if (of_a * of_b >= 0)
        return MISSES;
    int left = 0, right = 0;
    for (int i = 0; i < 3; ++i) {
        const int side = iccp_tets_orient(w->m, w->a, w->b, x[i], x[(i + 1) % 3]);
        left += side > 0;
        right += side < 0;
    }
    return left > 0 && right > 0 ? MISSES : left == 3 || right == 3 ? THROUGH : AT_EDGE;
}

static int meets_side(const way *w, uint32_t side)
{
    const iccp_tet *const tet = &w->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    return meets(w, (const uint32_t[3]){tet->v[f[0]], tet->v[f[1]], tet->v[f[2]]},
                 tet->v[side % 4]);
}

/* Lists the faces that are met, each from one side, and the tetrahedra there, beginning with one at
 * a that the way runs into. */
static bool follow(way *w, uint32_t first)
{
    iccp_tets *const m = w->m;
    const uint32_t stamp = iccp_tets_stamp(m);
    w->tets.n = w->crossed.n = 0;
    m->mark[first] = stamp;
    if (!iccp_list_push(m, &w->tets, first))
        return false;
    for (size_t k = 0; k < w->tets.n; ++k) {
        const uint32_t t = w->tets.item[k];
        for (uint32_t i = 0; i < 4; ++i) {
            const uint32_t across = m->tet[t].across[i];
            if (iccp_is_wall_side(across) || m->mark[across / 4] == stamp ||
                meets_side(w, 4 * t + i) == MISSES)
                continue;
            m->mark[across / 4] = stamp;
            if (!iccp_list_push(m, &w->crossed, 4 * t + i) ||
                !iccp_list_push(m, &w->tets, across / 4))
                return false;
        }
    }
    return true;
}

/* Less one for every face that would be met, of the triangle and, where side xz is an inner one,
 * of those from there to p and q. */
static double count(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz)
{
    const way *const w = context;
    if (iccp_tets_orient(w->m, x, y, z, w->q) <= 0 || iccp_tets_orient(w->m, y, x, z, w->p) <= 0)
        return -HUGE_VAL;
    int n = meets(w, (const uint32_t[3]){x, y, z}, w->q) != MISSES;
    if (inner_xz) {
        n += meets(w, (const uint32_t[3]){w->p, x, z}, ICCP_NO_TET) != MISSES;
        n += meets(w, (const uint32_t[3]){w->q, x, z}, ICCP_NO_TET) != MISSES;
    }
    return -n;
}

static bool try_edge(way *w, uint32_t tet, uint32_t p, uint32_t q)
{
    iccp_tets *const m = w->m;
    if (iccp_pairs_have(&w->s->edges, p, q) || !iccp_tets_ring(m, p, q, tet, ICCP_MOST_RING))
        return false;
    int n = 0;
    for (size_t k = 0; k < m->link.n; ++k)
        n += meets(w, (const uint32_t[3]){p, q, m->link.item[k]}, ICCP_NO_TET) != MISSES;
    w->p = p;
    w->q = q;
    const iccp_removal removal = {count, w, true};
    return iccp_remove_edge(m, p, q, &removal, -n);
}

static bool try_face(way *w, uint32_t side)
{
    const iccp_tet *const tet = &w->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    const uint32_t across = tet->across[side % 4];
    const uint32_t d = tet->v[side % 4], e = w->m->tet[across / 4].v[across % 4];
    for (int i = 0; i < 3; ++i)
        if (meets(w, (const uint32_t[3]){d, e, tet->v[f[i]]}, ICCP_NO_TET) != MISSES)
            return false;
    return iccp_remove_face(w->m, side);
}

/* One flip that lowers the number of faces that are met. */
static bool flip_once(way *w)
{
    for (size_t k = 0; k < w->crossed.n; ++k) {
        const uint32_t side = w->crossed.item[k];
        if (try_face(w, side))
            return true;
        const iccp_tet tet = w->m->tet[side / 4];
        const uint8_t *const f = iccp_tet_face[side % 4];
        for (int i = 0; i < 3; ++i)
            if (try_edge(w, side / 4, tet.v[f[i]], tet.v[f[(i + 1) % 3]]))
                return true;
    }
    return false;
}

typedef enum state { PRESENT, MISSING, STUCK, NO_MEMORY } state;

/* Makes edge ab by flips. */
static state recover(way *w)
{
    enum { MOST_FLIPS = 500 };
    for (int n = 0; n < MOST_FLIPS; ++n) {
        const uint32_t first = iccp_tets_towards(w->m, w->a, w->b);
        if (first == ICCP_NO_TET)
            return NO_MEMORY;
        if (iccp_tet_index(&w->m->tet[first], w->b) >= 0)
            return PRESENT;
        if (!follow(w, first))
            return NO_MEMORY;
        if (!flip_once(w))
            return MISSING;
    }
    return MISSING;
}

/* The edge of a face that the way from a to b meets, or false if it meets the inside. */
static bool met_edge(const way *w, uint32_t side, uint32_t edge[2])
{
    const iccp_tet *const tet = &w->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    for (int i = 0; i < 3; ++i) {
        edge[0] = tet->v[f[i]];
        edge[1] = tet->v[f[(i + 1) % 3]];
        if (iccp_tets_orient(w->m, w->a, w->b, edge[0], edge[1]) == 0)
            return true;
    }
    return false;
}

/* Where along the way a side is met. */
static double met_at(const way *w, uint32_t side)
{
    const iccp_tet *const tet = &w->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    const iccp_points *const p = &w->m->points;
    const double *const x = iccp_point(p, tet->v[f[0]]), *const y = iccp_point(p, tet->v[f[1]]),
                        *const z = iccp_point(p, tet->v[f[2]]);
    const double of_a = fabs(iccp_points_volume(x, y, z, iccp_point(p, w->a)));
    const double of_b = fabs(iccp_points_volume(x, y, z, iccp_point(p, w->b)));
    return of_a + of_b > 0.0 ? of_a / (of_a + of_b) : 0.5;
}

/* Where between two shares of a segment a side's plane is crossed, exactly as far as shares can be
 * told: by halving. -1: there is no memory. */
static double crossing(way *w, const iccp_segment *segment, uint32_t side, double from, double to)
{
    iccp_tets *const m = w->m;
    const int at_a = iccp_tet_sees(m, &m->tet[side / 4], (int)(side % 4), w->a);
    for (int step = 0; step < ICCP_FIXED_SHARE_BITS; ++step) {
        const double share = ldexp(floor(ldexp(0.5 * (from + to), 48)), -48);
        if (!(share > from && share < to))
            break;
        const iccp_dyadic made = {
            {segment->a, segment->b, segment->b}, w->b, {1.0 - share, share, 0.0}};
        const uint32_t p = iccp_tets_add_dyadic(m, &made);
        if (p == ICCP_NO_TET)
            return -1.0;
        const int at_p = iccp_tet_sees(m, &m->tet[side / 4], (int)(side % 4), p);
        iccp_tets_drop_dyadic(m);
        *(at_p == at_a ? &from : &to) = share;
    }
    return to;
}

/* Puts a point near share t of the way from a to b into the tetrahedra at a side, with as few bits
 * as it can be; it stands between a and b on the segment then. */
static state put_point(way *w, iccp_segment *segment, uint32_t side, double t)
{
    iccp_tets *const m = w->m;
    const double from = iccp_segment_share(m, segment, w->a);
    const double to = iccp_segment_share(m, segment, w->b);
    uint32_t edge[2];
    const bool at_edge = met_edge(w, side, edge);
    if (at_edge && !iccp_tets_ring(m, edge[0], edge[1], side / 4, m->n_tets))
        return STUCK;
    double at = from + t * (to - from);
    for (int bits = 3, turn = 0; turn < 2; bits += 3) {
        const double share = ldexp(floor(ldexp(at, bits) + 0.5), -bits);
        if (bits == ICCP_FIXED_SHARE_BITS) { /* doubles mistook the place */
            bits = 0;
            at = ++turn == 1 ? crossing(w, segment, side, from, to) : at;
            if (at < 0.0)
                return NO_MEMORY;
        }
        if (!(share > from && share < to))
            continue;
        const iccp_dyadic made = {{segment->a, segment->b, segment->b}, w->b,
                                  {1.0 - share, share, 0.0}};
        const uint32_t p = iccp_tets_add_dyadic(m, &made);
        if (p == ICCP_NO_TET)
            return NO_MEMORY;
        m->cavity.n = 0;
        if (!at_edge && (!iccp_list_push(m, &m->cavity, side / 4) ||
                         !iccp_list_push(m, &m->cavity, m->tet[side / 4].across[side % 4] / 4)))
            return NO_MEMORY;
        for (size_t k = 0; at_edge && k < m->ring.n; ++k)
            if (!iccp_list_push(m, &m->cavity, m->ring.item[k]))
                return NO_MEMORY;
        const iccp_inserted done = iccp_tets_insert(m, p, m->cavity.n, false);
        if (done == ICCP_INSERT_MEMORY)
            return NO_MEMORY;
        if (done == ICCP_INSERTED) {
            if (w->a == segment->a)
                segment->first = p;
            else
                m->points.dyadic[w->a - m->points.n_fixed].next = p;
            return PRESENT;
        }
        iccp_tets_drop_dyadic(m);
    }
    return STUCK;
}

/* A point on the way, where it meets something near the middle; elsewhere if that fails. */
static state split(way *w, iccp_segment *segment)
{
    while (w->crossed.n > 0) {
        size_t best = w->crossed.n;
        double best_at = 2.0;
        for (size_t k = 0; k < w->crossed.n; ++k) {
            const int how = meets_side(w, w->crossed.item[k]);
            const double at = how == WITHIN ? 2.0 : fabs(met_at(w, w->crossed.item[k]) - 0.5);
            if (at < best_at) {
                best_at = at;
                best = k;
            }
        }
        if (best == w->crossed.n)
            break;
        const uint32_t side = w->crossed.item[best];
        const state made = put_point(w, segment, side, met_at(w, side));
        if (made != STUCK)
            return made;
        w->crossed.item[best] = w->crossed.item[--w->crossed.n];
    }
    return STUCK;
}

/* All pieces of one segment from its beginning to its end. */
static state recover_segment(way *w, iccp_segment *segment, bool points)
{
    w->a = segment->a;
    while (w->a != segment->b) {
        w->b = iccp_segment_next(w->m, segment, w->a);
        const state made = recover(w);
        if (made == NO_MEMORY || (made == MISSING && !points))
            return made;
        if (made == PRESENT) {
            w->a = w->b;
            continue;
        }
        const state put =
            w->m->points.n_dyadic > w->most_points ? STUCK : split(w, segment);
        if (put != PRESENT)
            return put;
        const uint32_t p = iccp_segment_next(w->m, segment, w->a);
        if (iccp_pairs_add(&w->s->edges, w->a, p) == ICCP_PAIR_MEMORY ||
            iccp_pairs_add(&w->s->edges, p, w->b) == ICCP_PAIR_MEMORY)
            return NO_MEMORY;
    }
    return PRESENT;
}

icc_status iccp_recover_segments(iccp_tets *m, iccp_surface *s, const iccp_env *env,
                                 icc_error *err)
{
    enum { FLIP_PASSES = 2 };
    way w = {.m = m, .s = s, .most_points = 20 * s->n_segments + 1000};
    icc_status status = ICC_OK;
    for (size_t pass = 0, missing = 1; missing > 0 && status == ICC_OK; ++pass) {
        missing = 0;
        for (size_t e = 0; e < s->n_segments && status == ICC_OK; ++e) {
            const double share = ((double)pass + (double)e / (double)s->n_segments) / 3.0;
            if (e % 1024 == 0)
                status = iccp_explain(err, iccp_progress(env, "mesh", share));
            const state made = recover_segment(&w, &s->segment[e], pass >= FLIP_PASSES);
            missing += made == MISSING;
            if (made == NO_MEMORY)
                status = iccp_fail_memory(err);
            else if (made == STUCK)
                status = iccp_fail_facet(err, s->segment[e].facet,
                                         "one of its edges cannot be told from its surroundings");
        }
    }
    iccp_free(&m->memory, w.tets.item);
    iccp_free(&m->memory, w.crossed.item);
    return status;
}
