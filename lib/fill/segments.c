/* Recovers the edges of the surface. An edge that the mesh lacks crosses faces of it. Flips that
 * lower their number come first. If there is none, a point is put on the edge, where it crosses a
 * face or an edge of the mesh. The point is as near to that place as necessary to see, exactly,
 * both tetrahedra or the whole ring there.
 *
 * No edge is lost by that, and the two pieces cross fewer faces than the edge did, so finitely many
 * points suffice. The last resort may lose edges, which the next pass makes again. A limit on the
 * number of points ends it. */
#include "fill/segments.h"

#include "base/error.h"
#include "fill/flip.h"
#include "fill/obstacles.h"

#include <math.h>

/* Returns minus the number of faces that the missing edge would meet. Counts the triangle and, if
 * side xz is an inner one, the faces from there to p and q. */
static double count(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz)
{
    const iccp_obstacles *const o = context;
    if (iccp_tets_orient(o->m, x, y, z, o->q) <= 0 || iccp_tets_orient(o->m, y, x, z, o->p) <= 0)
        return -HUGE_VAL;
    int n = iccp_obstacles_meet(o, (const uint32_t[3]){x, y, z}, o->q) != ICCP_MISSES;
    if (inner_xz) {
        n += iccp_obstacles_meet(o, (const uint32_t[3]){o->p, x, z}, ICCP_NO_TET) != ICCP_MISSES;
        n += iccp_obstacles_meet(o, (const uint32_t[3]){o->q, x, z}, ICCP_NO_TET) != ICCP_MISSES;
    }
    return -n;
}

static bool try_edge(iccp_obstacles *o, uint32_t tet, uint32_t p, uint32_t q)
{
    iccp_tets *const m = o->m;
    if (iccp_pairs_have(&o->s->edges, p, q) || !iccp_tets_ring(m, p, q, tet, ICCP_MOST_RING))
        return false;
    int n = 0;
    for (size_t k = 0; k < m->link.n; ++k)
        n += iccp_obstacles_meet(o, (const uint32_t[3]){p, q, m->link.item[k]}, ICCP_NO_TET) !=
             ICCP_MISSES;
    o->p = p;
    o->q = q;
    const iccp_removal removal = {count, o, true};
    return iccp_remove_edge(m, p, q, &removal, -n);
}

static bool try_face(iccp_obstacles *o, uint32_t side)
{
    const iccp_tet *const tet = &o->m->tet[side / 4];
    const uint8_t *const f = iccp_tet_face[side % 4];
    const uint32_t across = tet->across[side % 4];
    const uint32_t d = tet->v[side % 4], e = o->m->tet[across / 4].v[across % 4];
    for (int i = 0; i < 3; ++i)
        if (iccp_obstacles_meet(o, (const uint32_t[3]){d, e, tet->v[f[i]]}, ICCP_NO_TET) !=
            ICCP_MISSES)
            return false;
    return iccp_remove_face(o->m, side);
}

/* Makes one flip that lowers the number of faces met. */
static bool flip_once(iccp_obstacles *o)
{
    for (size_t k = 0; k < o->crossed.n; ++k) {
        const uint32_t side = o->crossed.item[k];
        if (try_face(o, side))
            return true;
        const iccp_tet tet = o->m->tet[side / 4];
        const uint8_t *const f = iccp_tet_face[side % 4];
        for (int i = 0; i < 3; ++i)
            if (try_edge(o, side / 4, tet.v[f[i]], tet.v[f[(i + 1) % 3]]))
                return true;
    }
    return false;
}

/* Makes edge ab by flips. */
static iccp_recovery recover(iccp_obstacles *o)
{
    enum { MOST_FLIPS = 500 };
    for (int n = 0; n < MOST_FLIPS; ++n) {
        const uint32_t first = iccp_tets_towards(o->m, o->a, o->b);
        if (first == ICCP_NO_TET)
            return ICCP_NO_MEMORY;
        if (iccp_tet_index(&o->m->tet[first], o->b) >= 0)
            return ICCP_PRESENT;
        if (!iccp_obstacles_find(o, first))
            return ICCP_NO_MEMORY;
        if (!flip_once(o))
            return ICCP_MISSING;
    }
    return ICCP_MISSING;
}

/* Recovers all pieces of one segment from its beginning to its end. */
static iccp_recovery recover_segment(iccp_obstacles *o, iccp_segment *segment, bool points)
{
    o->a = segment->a;
    while (o->a != segment->b) {
        o->b = iccp_segment_next(o->m, segment, o->a);
        const iccp_recovery made = recover(o);
        if (made == ICCP_NO_MEMORY || (made == ICCP_MISSING && !points))
            return made;
        if (made == ICCP_PRESENT) {
            o->a = o->b;
            continue;
        }
        const iccp_recovery put =
            o->m->points.n_dyadic > o->most_points ? ICCP_STUCK : iccp_obstacles_split(o, segment);
        if (put != ICCP_PRESENT)
            return put;
        const uint32_t p = iccp_segment_next(o->m, segment, o->a);
        if (iccp_pairs_add(&o->s->edges, o->a, p) == ICCP_PAIR_MEMORY ||
            iccp_pairs_add(&o->s->edges, p, o->b) == ICCP_PAIR_MEMORY)
            return ICCP_NO_MEMORY;
    }
    return ICCP_PRESENT;
}

icc_status iccp_recover_segments(iccp_tets *m, iccp_surface *s, const iccp_env *env, icc_error *err)
{
    enum { FLIP_PASSES = 2 };
    iccp_obstacles o = {.m = m, .s = s, .most_points = 20 * s->n_segments + 1000};
    icc_status status = ICC_OK;
    for (size_t pass = 0, missing = 1; missing > 0 && status == ICC_OK; ++pass) {
        missing = 0;
        for (size_t e = 0; e < s->n_segments && status == ICC_OK; ++e) {
            const double share = ((double)pass + (double)e / (double)s->n_segments) / 3.0;
            if (e % 1024 == 0)
                status = iccp_explain(err, iccp_progress(env, "mesh", share));
            iccp_segment *const segment = &s->segment[iccp_tets_turn(m, e, s->n_segments)];
            const iccp_recovery made = recover_segment(&o, segment, pass >= FLIP_PASSES);
            missing += made == ICCP_MISSING || o.lost;
            o.lost = false;
            if (made == ICCP_NO_MEMORY)
                status = iccp_fail_memory(err);
            else if (made == ICCP_STUCK)
                status = iccp_fail_facet(
                    err, segment->facet,
                    "one of its edges is too close to its surroundings for double precision");
        }
    }
    iccp_free(&m->memory, o.tets.item);
    iccp_free(&m->memory, o.crossed.item);
    return status;
}
