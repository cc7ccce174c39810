/* Finds how a mesh meets a facet. The mesh cuts the facet into cells, each inside a tetrahedron or
 * a face. Cells are joined across faces, and around edges of the mesh that lie in the facet or
 * pierce it. The search starts with the rings of the facet's boundary edges and follows the rings
 * of all these edges. So it reaches every cell. */
#include "fill/facet_scan.h"

void iccp_facet_scan_init(iccp_facet_scan *scan, iccp_tets *m, const iccp_constraints *s)
{
    *scan = (iccp_facet_scan){.m = m, .s = s};
    scan->known.memory = m->memory;
}

void iccp_facet_scan_free(iccp_facet_scan *scan)
{
    iccp_pairs_free(&scan->known);
    iccp_free(&scan->m->memory, scan->edges.item);
    iccp_free(&scan->m->memory, scan->piercing.item);
    iccp_free(&scan->m->memory, scan->faces.item);
}

bool iccp_facet_pierced(const iccp_facet_scan *scan, uint32_t p, uint32_t q)
{
    const iccp_tets *const m = scan->m;
    const uint32_t *const c = scan->corners;
    if (iccp_is_on_facet(m, c, p) || iccp_is_on_facet(m, c, q))
        return false;
    const int of_p = iccp_tets_orient(m, c[0], c[1], c[2], p);
    if (of_p == 0 || of_p * iccp_tets_orient(m, c[0], c[1], c[2], q) >= 0)
        return false;
    int left = 0, right = 0;
    for (int i = 0; i < 3 && !(left > 0 && right > 0); ++i) {
        const int side = iccp_tets_orient(m, p, q, c[i], c[(i + 1) % 3]);
        left += side > 0;
        right += side < 0;
    }
    return !(left > 0 && right > 0);
}

static bool push_edge(iccp_facet_scan *scan, iccp_list *list, uint32_t p, uint32_t q, uint32_t tet)
{
    const iccp_pair_added added = iccp_pairs_add(&scan->known, p, q);
    if (added != ICCP_PAIR_NEW)
        return added == ICCP_PAIR_KNOWN;
    const uint32_t item[3] = {p, q, tet};
    for (int i = 0; i < 3; ++i)
        if (!iccp_list_push(scan->m, &scan->edges, item[i]) ||
            (list != NULL && !iccp_list_push(scan->m, list, item[i])))
            return false;
    return true;
}

static bool push_rim(iccp_facet_scan *scan)
{
    for (int i = 0; i < 3; ++i) {
        const iccp_segment *const segment =
            &scan->s->segment[scan->s->side[3 * (size_t)scan->facet + (size_t)i]];
        for (uint32_t p = segment->a; p != segment->b;) {
            const uint32_t q = iccp_segment_next(scan->m, segment, p);
            const uint32_t tet = iccp_tets_towards(scan->m, p, q);
            if (tet == ICCP_NO_TET || !push_edge(scan, NULL, p, q, tet))
                return false;
            p = q;
        }
    }
    return true;
}

/* Looks for a face that is the whole facet, at the first edge of the rim. Nothing pierces it. */
static bool find_whole(iccp_facet_scan *scan)
{
    iccp_tets *const m = scan->m;
    const uint32_t *const e = scan->edges.item, *const c = scan->corners;
    if (scan->edges.n != 9 || !iccp_tets_ring(m, e[0], e[1], e[2], m->n_tets))
        return false;
    for (size_t k = 0; k < m->link.n; ++k)
        if (m->link.item[k] == c[0] || m->link.item[k] == c[1] || m->link.item[k] == c[2]) {
            const uint32_t t = m->ring.item[k], beyond = m->link.item[(k + 1) % m->link.n];
            const int side = iccp_tet_index(&m->tet[t], beyond);
            return iccp_list_push(m, &scan->faces, 4 * t + (uint32_t)side);
        }
    return false;
}

/* Visits the edges of one tetrahedron that lie in the facet or pierce it, and its faces there. */
static bool visit(iccp_facet_scan *scan, uint32_t t)
{
    const iccp_tet *const tet = &scan->m->tet[t];
    bool on[4];
    int n_on = 0;
    for (int i = 0; i < 4; ++i)
        n_on += on[i] = iccp_is_on_facet(scan->m, scan->corners, tet->v[i]);
    for (int i = 0; i < 4; ++i)
        for (int j = i + 1; j < 4; ++j) {
            if (on[i] != on[j])
                continue;
            if (on[i] && !push_edge(scan, NULL, tet->v[i], tet->v[j], t))
                return false;
            if (!on[i] && iccp_facet_pierced(scan, tet->v[i], tet->v[j]) &&
                !push_edge(scan, &scan->piercing, tet->v[i], tet->v[j], t))
                return false;
        }
    for (uint32_t i = 0; i < 4 && n_on == 3; ++i)
        if (!on[i])
            return iccp_list_push(scan->m, &scan->faces, 4 * t + i);
    return true;
}

bool iccp_facet_scan_run(iccp_facet_scan *scan, uint32_t facet)
{
    iccp_tets *const m = scan->m;
    scan->facet = facet;
    scan->corners = scan->s->facets + 3 * (size_t)facet;
    iccp_pairs_clear(&scan->known);
    scan->edges.n = scan->piercing.n = scan->faces.n = 0;
    if (!push_rim(scan))
        return false;
    if (find_whole(scan))
        return true;
    for (size_t k = 0; k < scan->edges.n; k += 3) {
        const uint32_t *const e = scan->edges.item + k;
        if (!iccp_tets_ring(m, e[0], e[1], e[2], m->n_tets))
            return false;
        for (size_t i = 0; i < m->ring.n; ++i)
            if (!visit(scan, m->ring.item[i]))
                return false;
    }
    return true;
}
