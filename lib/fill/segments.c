/* An edge that the mesh lacks crosses faces of it. Flips that lower their number come first. When
 * there is none, a point is put on the edge, where it crosses a face or an edge: as near to there
 * as it takes to see, exactly, all of the two tetrahedra or the ring there. No edge is lost by
 * that, and the two pieces cross fewer faces than the edge did; so the points are finitely many.
 * The last resort may lose edges, for the next pass to make, and is ended by a limit on the
 * points. */
#include "fill/segments.h"

#include "base/error.h"
#include "fill/flip.h"
#include "fill/way.h"

#include <math.h>

/* Less one for every face that would be met, of the triangle and, where side xz is an inner one,
 * of those from there to p and q. */
static double count(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz)
{
    const iccp_way *const w = context;
    if (iccp_tets_orient(w->m, x, y, z, w->q) <= 0 || iccp_tets_orient(w->m, y, x, z, w->p) <= 0)
        return -HUGE_VAL;
    int n = iccp_way_meets(w, (const uint32_t[3]){x, y, z}, w->q) != ICCP_MISSES;
    if (inner_xz) {
        n += iccp_way_meets(w, (const uint32_t[3]){w->p, x, z}, ICCP_NO_TET) != ICCP_MISSES;
        n += iccp_way_meets(w, (const uint32_t[3]){w->q, x, z}, ICCP_NO_TET) != ICCP_MISSES;
    }
    return -n;
}

static bool try_edge(iccp_way *w, uint32_t tet, uint32_t p, uint32_t q)
{
    iccp_tets *const m = w->m;
    if (iccp_pairs_have(&w->s->edges, p, q) || !iccp_tets_ring(m, p, q, tet, ICCP_MOST_RING))
        return false;
    int n = 0;
    for (size_t k = 0; k < m->link.n; ++k)
        n += iccp_way_meets(w, (const uint32_t[3]){p, q, m->link.item[k]}, ICCP_NO_TET) !=
             ICCP_MISSES;
    w->p = p;
    w->q = q;
    const iccp_removal removal = {count, w, true};
    return iccp_remove_edge(m, p, q, &removal, -n);
}

static bool try_face(iccp_way *w, uint32_t side)
{
    const iccp_tet *const tet = &w->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    const uint32_t across = tet->across[side % 4];
    const uint32_t d = tet->v[side % 4], e = w->m->tet[across / 4].v[across % 4];
    for (int i = 0; i < 3; ++i)
        if (iccp_way_meets(w, (const uint32_t[3]){d, e, tet->v[f[i]]}, ICCP_NO_TET) != ICCP_MISSES)
            return false;
    return iccp_remove_face(w->m, side);
}

/* One flip that lowers the number of faces that are met. */
static bool flip_once(iccp_way *w)
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

/* Makes edge ab by flips. */
static iccp_recovery recover(iccp_way *w)
{
    enum { MOST_FLIPS = 500 };
    for (int n = 0; n < MOST_FLIPS; ++n) {
        const uint32_t first = iccp_tets_towards(w->m, w->a, w->b);
        if (first == ICCP_NO_TET)
            return ICCP_NO_MEMORY;
        if (iccp_tet_index(&w->m->tet[first], w->b) >= 0)
            return ICCP_PRESENT;
        if (!iccp_way_follow(w, first))
            return ICCP_NO_MEMORY;
        if (!flip_once(w))
            return ICCP_MISSING;
    }
    return ICCP_MISSING;
}

/* All pieces of one segment from its beginning to its end. */
static iccp_recovery recover_segment(iccp_way *w, iccp_segment *segment, bool points)
{
    w->a = segment->a;
    while (w->a != segment->b) {
        w->b = iccp_segment_next(w->m, segment, w->a);
        const iccp_recovery made = recover(w);
        if (made == ICCP_NO_MEMORY || (made == ICCP_MISSING && !points))
            return made;
        if (made == ICCP_PRESENT) {
            w->a = w->b;
            continue;
        }
        const iccp_recovery put =
            w->m->points.n_dyadic > w->most_points ? ICCP_STUCK : iccp_way_split(w, segment);
        if (put != ICCP_PRESENT)
            return put;
        const uint32_t p = iccp_segment_next(w->m, segment, w->a);
        if (iccp_pairs_add(&w->s->edges, w->a, p) == ICCP_PAIR_MEMORY ||
            iccp_pairs_add(&w->s->edges, p, w->b) == ICCP_PAIR_MEMORY)
            return ICCP_NO_MEMORY;
    }
    return ICCP_PRESENT;
}

icc_status iccp_recover_segments(iccp_tets *m, iccp_surface *s, const iccp_env *env, icc_error *err)
{
    enum { FLIP_PASSES = 2 };
    iccp_way w = {.m = m, .s = s, .most_points = 20 * s->n_segments + 1000};
    icc_status status = ICC_OK;
    for (size_t pass = 0, missing = 1; missing > 0 && status == ICC_OK; ++pass) {
        missing = 0;
        for (size_t e = 0; e < s->n_segments && status == ICC_OK; ++e) {
            const double share = ((double)pass + (double)e / (double)s->n_segments) / 3.0;
            if (e % 1024 == 0)
                status = iccp_explain(err, iccp_progress(env, "mesh", share));
            iccp_segment *const segment = &s->segment[iccp_tets_turn(m, e, s->n_segments)];
            const iccp_recovery made = recover_segment(&w, segment, pass >= FLIP_PASSES);
            missing += made == ICCP_MISSING || w.lost;
            w.lost = false;
            if (made == ICCP_NO_MEMORY)
                status = iccp_fail_memory(err);
            else if (made == ICCP_STUCK)
                status = iccp_fail_facet(err, segment->facet,
                                         "one of its edges cannot be told from its surroundings");
        }
    }
    iccp_free(&m->memory, w.tets.item);
    iccp_free(&m->memory, w.crossed.item);
    return status;
}
