/* Recovers facets. The edges of the mesh that pierce a facet are removed one by one, if possible by
 * an edge removal that makes no new piercing edge. Otherwise a point of the facet near the piercing
 * is inserted into the edge's ring. If it is near enough, it sees the whole ring, and its own edges
 * do not pierce. So the number of piercing edges falls until the facet is made of faces. Other
 * facets lose nothing, because an edge that pierces one facet lies on no other. */
#include "fill/facets.h"

#include "base/error.h"
#include "fill/facet_scan.h"
#include "fill/flip.h"
#include "fill/insert.h"
#include "fill/quality.h"

typedef struct piercing {
    iccp_facet_scan *scan;
    uint32_t p, q;
} piercing;

static double worth(void *context, uint32_t x, uint32_t y, uint32_t z, bool inner_xz)
{
    const piercing *const e = context;
    const iccp_tets *const m = e->scan->m;
    if (iccp_tets_orient(m, x, y, z, e->q) <= 0 || iccp_tets_orient(m, y, x, z, e->p) <= 0 ||
        (inner_xz && iccp_facet_pierced(e->scan, x, z)))
        return -HUGE_VAL;
    const double up = iccp_tets_quality(m, x, y, z, e->q);
    const double down = iccp_tets_quality(m, y, x, z, e->p);
    return up < down ? up : down;
}

/* Removes piercing edges and returns how many. */
static size_t remove_edges(iccp_facet_scan *scan)
{
    iccp_tets *const m = scan->m;
    size_t n = 0;
    for (size_t k = 0; k < scan->piercing.n; k += 3) {
        const uint32_t *const e = scan->piercing.item + k;
        const iccp_tet *const tet = &m->tet[e[2]];
        piercing edge = {scan, e[0], e[1]};
        const iccp_removal removal = {worth, &edge, false};
        if (iccp_tet_alive(m, e[2]) && iccp_tet_index(tet, e[0]) >= 0 &&
            iccp_tet_index(tet, e[1]) >= 0 && iccp_tets_ring(m, e[0], e[1], e[2], ICCP_MOST_RING) &&
            iccp_remove_edge(m, e[0], e[1], &removal, -HUGE_VAL))
            ++n;
    }
    return n;
}

/* Computes where edge pq meets the facet, as shares of its corners. */
static void piercing_at(const iccp_facet_scan *scan, uint32_t p, uint32_t q, double share[3])
{
    const iccp_points *const points = &scan->m->points;
    const double *const x = iccp_point(points, p), *const y = iccp_point(points, q);
    double sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        share[i] = fabs(iccp_points_volume(x, y, iccp_point(points, scan->corners[(i + 1) % 3]),
                                           iccp_point(points, scan->corners[(i + 2) % 3])));
        sum += share[i];
    }
    for (int i = 0; i < 3; ++i)
        share[i] = sum > 0.0 ? share[i] / sum : 1.0 / 3.0;
}

static iccp_inserted put_point(iccp_facet_scan *scan, const uint32_t edge[3])
{
    iccp_tets *const m = scan->m;
    double at[3];
    piercing_at(scan, edge[0], edge[1], at);
    if (!iccp_tets_ring(m, edge[0], edge[1], edge[2], m->n_tets))
        return ICCP_INSERT_MEMORY;
    for (int bits = 4; bits <= 48; bits += 4) {
        const double first = ldexp(floor(ldexp(at[0], bits) + 0.5), -bits);
        const double second = ldexp(floor(ldexp(at[1], bits) + 0.5), -bits);
        const uint32_t *const c = scan->corners;
        const iccp_dyadic made = {
            {c[0], c[1], c[2]}, ICCP_NO_TET, {first, second, 1.0 - first - second}};
        if (!(first > 0.0 && second > 0.0 && made.share[2] > 0.0))
            continue;
        const uint32_t p = iccp_tets_add_dyadic(m, &made);
        if (p == ICCP_NO_TET)
            return ICCP_INSERT_MEMORY;
        m->cavity.n = 0;
        for (size_t k = 0; k < m->ring.n; ++k)
            if (!iccp_list_push(m, &m->cavity, m->ring.item[k]))
                return ICCP_INSERT_MEMORY;
        const iccp_inserted done = iccp_tets_insert(m, p, m->cavity.n, false);
        if (done != ICCP_NOT_INSERTED)
            return done;
        iccp_tets_drop_dyadic(m);
    }
    return ICCP_NOT_INSERTED;
}

static icc_status recover(iccp_facet_scan *scan, uint32_t facet, icc_error *err)
{
    const size_t most_points = 40 * scan->s->n_segments + 2000;
    for (;;) {
        if (!iccp_facet_scan_run(scan, facet))
            return iccp_fail_memory(err);
        if (scan->piercing.n == 0)
            return ICC_OK;
        if (remove_edges(scan) > 0)
            continue;
        iccp_inserted done = ICCP_NOT_INSERTED;
        for (size_t k = scan->m->points.n_dyadic > most_points ? scan->piercing.n : 0;
             k < scan->piercing.n && done == ICCP_NOT_INSERTED; k += 3)
            done = put_point(scan, scan->piercing.item + k);
        if (done == ICCP_INSERT_MEMORY)
            return iccp_fail_memory(err);
        if (done != ICCP_INSERTED)
            return iccp_fail_facet(err, facet,
                                   "it is too close to its surroundings for double precision");
    }
}

icc_status iccp_recover_facets(iccp_tets *m, const iccp_constraints *s, const iccp_env *env,
                               icc_error *err)
{
    iccp_facet_scan scan;
    icc_status status = ICC_OK;
    iccp_facet_scan_init(&scan, m, s);
    for (uint32_t f = 0; f < s->n_facets && status == ICC_OK; ++f) {
        if (f % 1024 == 0)
            status = iccp_explain(err, iccp_progress(env, "mesh", (double)f / (double)s->n_facets));
        if (status == ICC_OK)
            status = recover(&scan, f, err);
    }
    iccp_facet_scan_free(&scan);
    return status;
}
