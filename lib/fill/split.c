/* Puts points exactly on segments. fill/segments.c says why. */
#include "fill/fixed.h"
#include "fill/insert.h"
#include "fill/obstacles.h"

#include <math.h>

/* Finds the edge of a face that segment ab meets. Returns false if it meets the inside of the
 * face. */
static bool met_edge(const iccp_obstacles *o, uint32_t side, uint32_t edge[2])
{
    const iccp_tet *const tet = &o->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    for (int i = 0; i < 3; ++i) {
        edge[0] = tet->v[f[i]];
        edge[1] = tet->v[f[(i + 1) % 3]];
        if (iccp_tets_orient(o->m, o->a, o->b, edge[0], edge[1]) == 0)
            return true;
    }
    return false;
}

/* Returns where along ab a side is met. */
static double met_at(const iccp_obstacles *o, uint32_t side)
{
    const iccp_tet *const tet = &o->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    const iccp_points *const p = &o->m->points;
    const double *const x = iccp_point(p, tet->v[f[0]]), *const y = iccp_point(p, tet->v[f[1]]),
                        *const z = iccp_point(p, tet->v[f[2]]);
    const double of_a = fabs(iccp_points_volume(x, y, z, iccp_point(p, o->a)));
    const double of_b = fabs(iccp_points_volume(x, y, z, iccp_point(p, o->b)));
    return of_a + of_b > 0.0 ? of_a / (of_a + of_b) : 0.5;
}

/* Returns where a segment crosses the plane of a side, between two shares of the segment. Bisection
 * finds it exactly, as far as shares can represent it. Returns -1 if there is no memory. */
static double crossing(iccp_obstacles *o, const iccp_segment *segment, uint32_t side, double from,
                       double to)
{
    iccp_tets *const m = o->m;
    const int at_a = iccp_tet_sees(m, &m->tet[side / 4], (int)(side % 4), o->a);
    for (int step = 0; step < ICCP_FIXED_SHARE_BITS; ++step) {
        const double share = ldexp(floor(ldexp(0.5 * (from + to), 48)), -48);
        if (!(share > from && share < to))
            break;
        const iccp_dyadic made = {
            {segment->a, segment->b, segment->b}, o->b, {1.0 - share, share, 0.0}};
        const uint32_t p = iccp_tets_add_dyadic(m, &made);
        if (p == ICCP_NO_TET)
            return -1.0;
        const int at_p = iccp_tet_sees(m, &m->tet[side / 4], (int)(side % 4), p);
        iccp_tets_drop_dyadic(m);
        *(at_p == at_a ? &from : &to) = share;
    }
    return to;
}

/* Sets m->cavity to the ring of an edge of tetrahedron t, or to nothing if the edge belongs to the
 * surface. */
static bool take_ring(iccp_obstacles *o, uint32_t t, const uint32_t edge[2])
{
    iccp_tets *const m = o->m;
    m->cavity.n = 0;
    if (iccp_pairs_have(&o->s->edges, edge[0], edge[1]) ||
        !iccp_tets_ring(m, edge[0], edge[1], t, m->n_tets))
        return !m->no_memory;
    for (size_t k = 0; k < m->ring.n; ++k)
        if (!iccp_list_push(m, &m->cavity, m->ring.item[k]))
            return false;
    return true;
}

/* Fills in m->cavity for a point at a side: the two tetrahedra there, or the ring of the edge that
 * ab meets. If that was too narrow, `turn` selects the ring of the side's edge number turn - 1. */
static bool take_cavity(iccp_obstacles *o, uint32_t side, int turn)
{
    iccp_tets *const m = o->m;
    const iccp_tet *const tet = &m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    uint32_t edge[2];
    if (turn > 0) {
        edge[0] = tet->v[f[turn - 1]];
        edge[1] = tet->v[f[turn % 3]];
        return take_ring(o, side / 4, edge);
    }
    if (met_edge(o, side, edge))
        return take_ring(o, side / 4, edge);
    m->cavity.n = 0;
    return iccp_list_push(m, &m->cavity, side / 4) &&
           iccp_list_push(m, &m->cavity, tet->across[side % 4] / 4);
}

/* Returns true if a side of the cavity contains both points. Its tetrahedra have the stamp. */
static bool is_at_rim(const iccp_tets *m, uint32_t a, uint32_t b, uint32_t stamp)
{
    for (size_t k = 0; k < m->cavity.n; ++k) {
        const iccp_tet *const tet = &m->tet[m->cavity.item[k]];
        const int i = iccp_tet_index(tet, a), j = iccp_tet_index(tet, b);
        for (int side = 0; side < 4 && i >= 0 && j >= 0; ++side)
            if (side != i && side != j &&
                (iccp_is_wall_side(tet->across[side]) || m->mark[tet->across[side] / 4] != stamp))
                return true;
    }
    return false;
}

/* Returns true if every edge of the surface in m->cavity is also at its rim. */
static bool keeps_edges(iccp_obstacles *o)
{
    iccp_tets *const m = o->m;
    const uint32_t stamp = iccp_tets_stamp(m);
    for (size_t k = 0; k < m->cavity.n; ++k)
        m->mark[m->cavity.item[k]] = stamp;
    for (size_t k = 0; k < m->cavity.n; ++k)
        for (int i = 0; i < 4; ++i)
            for (int j = i + 1; j < 4; ++j) {
                const uint32_t *const v = m->tet[m->cavity.item[k]].v;
                if (iccp_pairs_have(&o->s->edges, v[i], v[j]) && !is_at_rim(m, v[i], v[j], stamp))
                    return false;
            }
    return true;
}

/* Extends m->cavity from a side until a point sees the whole rim. Returns false if that takes too
 * many tetrahedra, or removes an edge of the surface that must stay. */
static bool widen(iccp_obstacles *o, uint32_t side, uint32_t p)
{
    enum { MOST = 100 };
    iccp_tets *const m = o->m;
    return take_cavity(o, side, 0) && m->cavity.n > 0 && iccp_tets_extend(m, p, MOST) &&
           m->cavity.n <= MOST && (o->may_lose || keeps_edges(o));
}

/* Makes the point that was added last an ordinary one, as near to its place as doubles are. Keeps
 * its share of the segment. */
static void round_point(iccp_points *points)
{
    iccp_dyadic *const d = &points->dyadic[points->n_dyadic - 1];
    d->share[0] = 0.0;
    iccp_frame_between(points->frame, iccp_point(points, d->of[0]), iccp_point(points, d->of[1]),
                       d->share[1], points->x + 3 * (points->n - 1));
}

/* Puts a point at a share of the segment into the space of m->cavity, between a and b. The point
 * must see the whole rim. */
static iccp_recovery put_at(iccp_obstacles *o, iccp_segment *segment, double share, uint32_t side,
                            bool wide)
{
    iccp_tets *const m = o->m;
    const iccp_dyadic made = {
        {segment->a, segment->b, segment->b}, o->b, {1.0 - share, share, 0.0}};
    const uint32_t p = iccp_tets_add_dyadic(m, &made);
    if (p == ICCP_NO_TET)
        return ICCP_NO_MEMORY;
    if (o->rounded)
        round_point(&m->points);
    const iccp_inserted done =
        wide && !widen(o, side, p) ? ICCP_NOT_INSERTED : iccp_tets_insert(m, p, m->cavity.n, false);
    if (done == ICCP_INSERT_MEMORY || m->no_memory)
        return ICCP_NO_MEMORY;
    if (done != ICCP_INSERTED) {
        iccp_tets_drop_dyadic(m);
        return ICCP_STUCK;
    }
    if (o->a == segment->a)
        segment->first = p;
    else
        m->points.dyadic[o->a - m->points.n_fixed].next = p;
    return ICCP_PRESENT;
}

/* Puts a point as near to a share as necessary, with as few bits as possible. In a metric the share
 * is never a simple fraction. In grids that were stretched and rounded, points at simple fractions
 * lie on lines through other points, except for the last bit. Then no share is left between them
 * and these lines. */
static iccp_recovery put_near(iccp_obstacles *o, iccp_segment *segment, double at, int most_bits)
{
    enum { FEW_BITS = 3, ODD_BITS = 9 };
    const bool odd = o->m->metric.on;
    const double from = iccp_segment_share(o->m, segment, o->a);
    const double to = iccp_segment_share(o->m, segment, o->b);
    for (int bits = odd ? ODD_BITS : FEW_BITS; bits <= most_bits; bits += 3) {
        const double share = odd ? ldexp(2.0 * floor(ldexp(at, bits - 1)) + 1.0, -bits)
                                 : ldexp(floor(ldexp(at, bits) + 0.5), -bits);
        if (!(share > from && share < to))
            continue;
        const iccp_recovery made = put_at(o, segment, share, 0, false);
        if (made != ICCP_STUCK)
            return made;
    }
    return ICCP_STUCK;
}

/* Puts a point where a side is met: first as computed in doubles, then by exact signs. */
static iccp_recovery put_at_side(iccp_obstacles *o, iccp_segment *segment, uint32_t side,
                                 int most_bits)
{
    const double from = iccp_segment_share(o->m, segment, o->a);
    const double to = iccp_segment_share(o->m, segment, o->b);
    const double rough = from + met_at(o, side) * (to - from);
    double exact = -1.0;
    for (int turn = 0; turn < 4; ++turn)
        for (int how = 0; how < 2; ++how) {
            if (how == 1 && exact < 0.0) {
                exact = crossing(o, segment, side, from, to);
                if (exact < 0.0)
                    return ICCP_NO_MEMORY;
            }
            if (!take_cavity(o, side, turn))
                return ICCP_NO_MEMORY;
            if (o->m->cavity.n == 0)
                break;
            const iccp_recovery made = put_near(o, segment, how == 1 ? exact : rough, most_bits);
            if (made != ICCP_STUCK)
                return made;
        }
    return ICCP_STUCK;
}

/* Puts a point well between a and b. Its cavity contains everything between it and a side. */
static iccp_recovery put_between(iccp_obstacles *o, iccp_segment *segment, uint32_t side)
{
    static const double places[] = {0.375, 0.625, 0.25, 0.75, 0.125, 0.875, 0.0625, 0.9375};
    const double from = iccp_segment_share(o->m, segment, o->a);
    const double to = iccp_segment_share(o->m, segment, o->b);
    int bits = 0;
    while (bits < ICCP_FIXED_SHARE_BITS && ldexp(to - from, bits) < 32.0)
        ++bits;
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        const double share = ldexp(floor(ldexp(from + places[i] * (to - from), bits)), -bits);
        if (!(share > from && share < to))
            continue;
        const iccp_recovery made = put_at(o, segment, share, side, true);
        if (made != ICCP_STUCK)
            return made;
    }
    return ICCP_STUCK;
}

/* A function that puts a point near a side. */
typedef iccp_recovery put_point(iccp_obstacles *o, iccp_segment *segment, uint32_t side);

static iccp_recovery put_coarsely(iccp_obstacles *o, iccp_segment *segment, uint32_t side)
{
    enum { COARSE_BITS = 24 };
    return put_at_side(o, segment, side, COARSE_BITS);
}

static iccp_recovery put_finely(iccp_obstacles *o, iccp_segment *segment, uint32_t side)
{
    return put_at_side(o, segment, side, ICCP_FIXED_SHARE_BITS);
}

/* Tries the sides that ab meets, those near the middle first. */
static iccp_recovery put_somewhere(iccp_obstacles *o, iccp_segment *segment, put_point *put)
{
    uint32_t *const side = o->crossed.item;
    for (size_t n = o->crossed.n; n > 0; --n) {
        size_t best = n;
        double best_at = 2.0;
        for (size_t k = 0; k < n; ++k) {
            const int how = iccp_obstacles_meet_side(o, side[k]);
            const double at = how == ICCP_WITHIN ? 2.0 : fabs(met_at(o, side[k]) - 0.5);
            if (at < best_at) {
                best_at = at;
                best = k;
            }
        }
        if (best == n)
            break;
        const uint32_t chosen = side[best];
        const iccp_recovery made = put(o, segment, chosen);
        if (made != ICCP_STUCK)
            return made;
        side[best] = side[n - 1];
        side[n - 1] = chosen;
    }
    return ICCP_STUCK;
}

/* The metric is used for surfaces that were refused without it. There a point is put near other
 * points only if none can be put well between a and b. As a last resort, other edges of the surface
 * may be lost. They are then made again, with as many points as are allowed in all. */
iccp_recovery iccp_obstacles_split(iccp_obstacles *o, iccp_segment *segment)
{
    iccp_recovery made = ICCP_STUCK;
    if (o->m->metric.on) {
        made = put_somewhere(o, segment, put_coarsely);
        if (made == ICCP_STUCK)
            made = put_somewhere(o, segment, put_between);
    }
    if (made == ICCP_STUCK)
        made = put_somewhere(o, segment, put_finely);
    if (o->m->metric.on && made == ICCP_STUCK) {
        o->may_lose = true;
        made = put_somewhere(o, segment, put_between);
        o->may_lose = false;
        o->lost |= made == ICCP_PRESENT;
    }
    return made;
}
