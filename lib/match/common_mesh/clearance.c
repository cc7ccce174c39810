/* Finds out whether a changed surface would meet itself. The boxes of a tree follow triangles that
 * move: C. Ericson, Real-Time Collision Detection, section 6.3.4. Here boxes only grow, because a
 * triangle stays close to the triangles that it replaced. */
#include "match/common_mesh/clearance.h"

#include "domain/simplicial.h"
#include "geometry/triangles.h"

bool iccp_clearance_create(iccp_clearance *c, const iccp_half_edges *m, const double *x,
                           const iccp_memory *memory)
{
    *c = (iccp_clearance){.m = m};
    iccp_facet_tree_create(&c->tree, 3, x, m->n_faces, m->origin, memory);
    c->place = iccp_alloc(memory, m->n_faces, sizeof *c->place);
    if (c->tree.boxes == NULL || c->place == NULL)
        return false;
    for (uint32_t place = 0; place < m->n_faces; ++place)
        c->place[iccp_facet_at(&c->tree, place)] = place;
    return true;
}

void iccp_clearance_free(iccp_clearance *c, const iccp_memory *memory)
{
    iccp_facet_tree_free(&c->tree, memory);
    iccp_free(memory, c->place);
}

/* Returns true if new triangle number k of `fresh` meets another triangle that stays. */
static bool meets_any(const iccp_clearance *c, const iccp_facet_tree *fresh, uint32_t k,
                      size_t n_old, const uint32_t *old)
{
    const iccp_half_edges *const m = c->m;
    iccp_facet_query query;
    double box[6];
    uint32_t g;
    iccp_facet_box(fresh, k, box);
    iccp_facet_query_start(&query, &c->tree, box);
    while (iccp_facet_query_next(&query, &g)) {
        const uint32_t *const t = m->origin + 3 * (size_t)g;
        bool stays = m->degree[t[0]] > 0 && m->degree[t[1]] > 0 && m->degree[t[2]] > 0;
        for (size_t i = 0; i < n_old; ++i)
            stays = stays && old[i] != g;
        if (stays && iccp_triangles_meet(fresh->vertices, fresh->facets + 3 * (size_t)k, t))
            return true;
    }
    return false;
}

/* Two new triangles need not be compared. If they meet, an edge of one passes through the other.
 * That edge is not common to both, and the triangle on its other side, which stays, meets the other
 * new triangle as well. */
bool iccp_clearance_allows(const iccp_clearance *c, size_t n_old, const uint32_t *old, size_t n,
                           const uint32_t (*corners)[3])
{
    const iccp_facet_tree fresh = {
        .dim = 3, .n_corners = 3, .n = n, .vertices = c->tree.vertices, .facets = corners[0]};
    for (uint32_t k = 0; k < n; ++k)
        if (!iccp_simplicial_has_area(&fresh, k))
            return false;
    for (uint32_t k = 0; k < n; ++k)
        if (meets_any(c, &fresh, k, n_old, old))
            return false;
    return true;
}

void iccp_clearance_replace(iccp_clearance *c, size_t n, const uint32_t *numbers,
                            const uint32_t (*corners)[3])
{
    const iccp_facet_tree fresh = {
        .dim = 3, .n_corners = 3, .n = n, .vertices = c->tree.vertices, .facets = corners[0]};
    for (uint32_t k = 0; k < n; ++k) {
        double box[6];
        iccp_facet_box(&fresh, k, box);
        iccp_facet_tree_include(&c->tree, c->place[numbers[k]], box);
    }
}
