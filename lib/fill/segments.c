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

static icc_status fail_segment(const iccp_obstacles *o, const iccp_segment *segment, icc_error *err)
{
    if (!o->rounded)
        return iccp_fail_facet(
            err, segment->facet,
            "one of its edges is too close to its surroundings for double precision");
    return iccp_fail_at(err, ICC_ERR_RESOLUTION, ICC_ITEM_FEATURE, (int64_t)segment->facet,
                        "feature %lu: a segment of the line is too close to its surroundings for "
                        "double precision",
                        (unsigned long)segment->facet);
}

static icc_status recover_all(iccp_obstacles *o, size_t n, iccp_segment *segments,
                              const iccp_env *env, icc_error *err)
{
    enum { FLIP_PASSES = 2 };
    icc_status status = ICC_OK;
    o->most_points = 20 * n + 1000;
    for (size_t pass = 0, missing = 1; missing > 0 && status == ICC_OK; ++pass) {
        missing = 0;
        for (size_t e = 0; e < n && status == ICC_OK; ++e) {
            const double share = ((double)pass + (double)e / (double)n) / 3.0;
            if (e % 1024 == 0)
                status = iccp_explain(err, iccp_progress(env, "mesh", share));
            iccp_segment *const segment = &segments[iccp_tets_turn(o->m, e, n)];
            const iccp_recovery made = recover_segment(o, segment, pass >= FLIP_PASSES);
            missing += made == ICCP_MISSING || o->lost;
            o->lost = false;
            if (made == ICCP_NO_MEMORY)
                status = iccp_fail_memory(err);
            else if (made == ICCP_STUCK)
                status = fail_segment(o, segment, err);
        }
    }
    iccp_free(&o->m->memory, o->tets.item);
    iccp_free(&o->m->memory, o->crossed.item);
    return status;
}

icc_status iccp_recover_segments(iccp_tets *m, iccp_constraints *s, const iccp_env *env,
                                 icc_error *err)
{
    iccp_obstacles o = {.m = m, .s = s};
    return recover_all(&o, s->n_segments, s->segment, env, err);
}

/* Lists the points that were put on lines, and keeps all pieces of lines. */
static bool keep_lines(iccp_tets *m, iccp_constraints *s)
{
    const size_t n = m->points.n_dyadic;
    s->on_line = iccp_alloc(&s->memory, n, sizeof *s->on_line);
    if (s->on_line == NULL)
        return false;
    for (size_t e = 0; e < s->n_lines; ++e) {
        const iccp_segment *const line = &s->line[e];
        for (uint32_t p = line->a; p != line->b;) {
            const uint32_t q = iccp_segment_next(m, line, p);
            if (iccp_pairs_add(&m->kept, p, q) == ICCP_PAIR_MEMORY)
                return false;
            if (q != line->b)
                s->on_line[s->n_on_lines++] =
                    (iccp_on_line){q, line->a, line->b, iccp_segment_share(m, line, q)};
            p = q;
        }
    }
    return true;
}

/* Afterwards the points on lines stay where they are, like vertices. */
icc_status iccp_recover_lines(iccp_tets *m, iccp_constraints *s, const iccp_env *env,
                              icc_error *err)
{
    iccp_obstacles o = {.m = m, .s = s, .rounded = true};
    icc_status status = ICC_OK;
    for (size_t e = 0; e < s->n_lines && status == ICC_OK; ++e)
        if (iccp_pairs_add(&s->edges, s->line[e].a, s->line[e].b) == ICCP_PAIR_MEMORY)
            status = iccp_fail_memory(err);
    if (status == ICC_OK)
        status = recover_all(&o, s->n_lines, s->line, env, err);
    if (status == ICC_OK && !keep_lines(m, s))
        status = iccp_fail_memory(err);
    m->points.n_dyadic = 0;
    m->points.n_fixed = m->points.n;
    return status;
}
