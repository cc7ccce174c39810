/* Points on segments, exactly: see fill/segments.c. */
#include "fill/fixed.h"
#include "fill/insert.h"
#include "fill/way.h"

#include <math.h>

/* The edge of a face that the way from a to b meets, or false if it meets the inside. */
static bool met_edge(const iccp_way *w, uint32_t side, uint32_t edge[2])
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
static double met_at(const iccp_way *w, uint32_t side)
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
static double crossing(iccp_way *w, const iccp_segment *segment, uint32_t side, double from,
                       double to)
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

/* Puts a point as near to a share as it takes to see all of m->cavity, with as few bits as it can
 * be; it stands between a and b on the segment then. */
static iccp_recovery put_near(iccp_way *w, iccp_segment *segment, double at)
{
    iccp_tets *const m = w->m;
    const double from = iccp_segment_share(m, segment, w->a);
    const double to = iccp_segment_share(m, segment, w->b);
    for (int bits = 3; bits <= ICCP_FIXED_SHARE_BITS; bits += 3) {
        const double share = ldexp(floor(ldexp(at, bits) + 0.5), -bits);
        if (!(share > from && share < to))
            continue;
        const iccp_dyadic made = {
            {segment->a, segment->b, segment->b}, w->b, {1.0 - share, share, 0.0}};
        const uint32_t p = iccp_tets_add_dyadic(m, &made);
        if (p == ICCP_NO_TET)
            return ICCP_NO_MEMORY;
        const iccp_inserted done = iccp_tets_insert(m, p, m->cavity.n, false);
        if (done == ICCP_INSERT_MEMORY)
            return ICCP_NO_MEMORY;
        if (done == ICCP_INSERTED) {
            if (w->a == segment->a)
                segment->first = p;
            else
                m->points.dyadic[w->a - m->points.n_fixed].next = p;
            return ICCP_PRESENT;
        }
        iccp_tets_drop_dyadic(m);
    }
    return ICCP_STUCK;
}

/* m->cavity: the ring of an edge of tetrahedron t, or nothing if that is an edge of the surface. */
static bool take_ring(iccp_way *w, uint32_t t, const uint32_t edge[2])
{
    iccp_tets *const m = w->m;
    m->cavity.n = 0;
    if (iccp_pairs_have(&w->s->edges, edge[0], edge[1]) ||
        !iccp_tets_ring(m, edge[0], edge[1], t, m->n_tets))
        return !m->no_memory;
    for (size_t k = 0; k < m->ring.n; ++k)
        if (!iccp_list_push(m, &m->cavity, m->ring.item[k]))
            return false;
    return true;
}

/* Fills in m->cavity for a point at a side: the two tetrahedra there, or the ring of the edge that
 * is met; else, where that was too narrow, the ring of the side's edge number turn - 1. */
static bool take_cavity(iccp_way *w, uint32_t side, int turn)
{
    iccp_tets *const m = w->m;
    const iccp_tet *const tet = &m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    uint32_t edge[2];
    if (turn > 0) {
        edge[0] = tet->v[f[turn - 1]];
        edge[1] = tet->v[f[turn % 3]];
        return take_ring(w, side / 4, edge);
    }
    if (met_edge(w, side, edge))
        return take_ring(w, side / 4, edge);
    m->cavity.n = 0;
    return iccp_list_push(m, &m->cavity, side / 4) &&
           iccp_list_push(m, &m->cavity, tet->across[side % 4] / 4);
}

/* Puts a point where a side is met: as doubles tell, then as exact signs do. */
static iccp_recovery put_point(iccp_way *w, iccp_segment *segment, uint32_t side)
{
    const double from = iccp_segment_share(w->m, segment, w->a);
    const double to = iccp_segment_share(w->m, segment, w->b);
    const double rough = from + met_at(w, side) * (to - from);
    double exact = -1.0;
    for (int turn = 0; turn < 4; ++turn)
        for (int how = 0; how < 2; ++how) {
            if (how == 1 && exact < 0.0) {
                exact = crossing(w, segment, side, from, to);
                if (exact < 0.0)
                    return ICCP_NO_MEMORY;
            }
            if (!take_cavity(w, side, turn))
                return ICCP_NO_MEMORY;
            if (w->m->cavity.n == 0)
                break;
            const iccp_recovery made = put_near(w, segment, how == 1 ? exact : rough);
            if (made != ICCP_STUCK)
                return made;
        }
    return ICCP_STUCK;
}

iccp_recovery iccp_way_split(iccp_way *w, iccp_segment *segment)
{
    while (w->crossed.n > 0) {
        size_t best = w->crossed.n;
        double best_at = 2.0;
        for (size_t k = 0; k < w->crossed.n; ++k) {
            const int how = iccp_way_meets_side(w, w->crossed.item[k]);
            const double at = how == ICCP_WITHIN ? 2.0 : fabs(met_at(w, w->crossed.item[k]) - 0.5);
            if (at < best_at) {
                best_at = at;
                best = k;
            }
        }
        if (best == w->crossed.n)
            break;
        const uint32_t side = w->crossed.item[best];
        const iccp_recovery made = put_point(w, segment, side);
        if (made != ICCP_STUCK)
            return made;
        w->crossed.item[best] = w->crossed.item[--w->crossed.n];
    }
    return ICCP_STUCK;
}
