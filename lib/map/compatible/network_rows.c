/* Checks that the mesh of a map follows the network of its source.
 *
 * A side has two half-sides, one for each direction. Where the domain lies on the left of a
 * half-side, edges of triangles run along it: one leaves its first node, one reaches its last node,
 * and one reaches and one leaves each vertex between. Places grow along each edge. So these edges
 * are one row. */
#include "map/compatible/network_rows.h"

#include "domain/network.h"

#include <math.h>
#include <string.h>

/* The edges found along a half-side: one leaves its first node, one reaches its last. A vertex
 * between the nodes of a side has these bits twice, once for each half-side. */
enum bits { LEFT = 1, REACHED = 2, WHOLE = LEFT | REACHED };

typedef struct rows {
    const iccp_plmap *map;
    const iccp_network *network;
    uint8_t *half;   /* by half-side: LEFT at its first node, REACHED at its last */
    uint8_t *inner;  /* by vertex between nodes: bits, those of the second half-side times 4 */
    uint8_t *is_met; /* by vertex: a triangle has it */
} rows;

/* Sets a bit that must be clear. */
static bool mark(uint8_t *bits, int bit)
{
    const bool was_clear = (*bits & bit) == 0;
    *bits = (uint8_t)(*bits | bit);
    return was_clear;
}

/* Marks an end of an edge that runs along a half-side. */
static bool mark_end(rows *r, uint32_t v, uint32_t half, int bit)
{
    return iccp_plmap_node(r->map, v) != UINT32_MAX
               ? mark(&r->half[half], bit)
               : mark(&r->inner[v], half % 2 == 0 ? bit : 4 * bit);
}

/* Marks the edge that a corner faces, if it runs along a side. An edge without a twin must. */
static bool mark_edge(rows *r, uint32_t corner)
{
    const iccp_corners *c = &r->map->corners;
    const uint32_t a = c->vertex[iccp_after(corner)], b = c->vertex[iccp_before(corner)];
    const bool is_open = c->twin[corner] == ICCP_NO_NEIGHBOUR;
    uint32_t facet;
    double from, to;
    r->is_met[c->vertex[corner]] = 1;
    if (!iccp_plmap_on_line(r->map, a, b, &facet, &from, &to))
        return !is_open;
    const uint32_t half = 2 * facet + (from > to);
    return (from < to || from > to) && is_open == (r->network->face[half ^ 1] == ICCP_NO_FACE) &&
           mark_end(r, a, half, LEFT) && mark_end(r, b, half, REACHED);
}

/* What a half-side must have. */
static int wanted(const rows *r, uint32_t half)
{
    return r->network->face[half] != ICCP_NO_FACE ? WHOLE : 0;
}

/* Whether a vertex belongs to a triangle, has what it must have, and is fixed in the only way that
 * its place allows. */
static bool is_good(const rows *r, uint32_t v)
{
    const iccp_plmap *map = r->map;
    const uint32_t facet = map->facet[v], node = iccp_plmap_node(map, v);
    if (map->fixed[v] == ICCP_FREE || !r->is_met[v])
        return r->is_met[v];
    if (map->fixed[v] != ICCP_ON_NETWORK || r->network->side[facet] != facet)
        return false;
    return node != UINT32_MAX ? r->network->place[node] == 2 * facet + (map->along[v] > 0)
                              : r->inner[v] == wanted(r, 2 * facet) + 4 * wanted(r, 2 * facet + 1);
}

static bool follow(rows *r)
{
    const iccp_plmap *map = r->map;
    const icc_domain *source = map->featured;
    bool is = true;
    for (uint32_t c = 0; is && c < 3 * map->corners.n_triangles; ++c)
        is = mark_edge(r, c);
    for (uint32_t v = 0; is && v < map->n_vertices; ++v)
        is = is_good(r, v);
    for (uint32_t f = 0; is && f < source->features->n_places; ++f)
        if (iccp_network_is_side(r->network, source, f))
            is = r->half[2 * f] == wanted(r, 2 * f) && r->half[2 * f + 1] == wanted(r, 2 * f + 1);
    return is;
}

static bool is_near(const icc_domain *domain, uint32_t facet, double along, const double *point)
{
    const double bary[2] = {1 - along, along};
    double wanted[2];
    iccp_domain_facet_point(domain, facet, bary, wanted);
    return fabs(point[0] - wanted[0]) <= domain->band.tolerance &&
           fabs(point[1] - wanted[1]) <= domain->band.tolerance;
}

bool iccp_plmap_is_at_place(const iccp_plmap *map, size_t v, const icc_domain *source,
                            const icc_domain *target)
{
    return is_near(source, map->facet[v], map->along[v], map->points + 2 * v) &&
           is_near(target, map->facet[v], map->along[v], map->images + 2 * v);
}

icc_status iccp_check_rows(bool *follows, const iccp_plmap *map, const icc_domain *target,
                           const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    const icc_domain *source = map->featured;
    uint32_t *vertex = iccp_alloc(memory, source->n_vertices, sizeof *vertex);
    rows r = {.map = map,
              .network = iccp_network_of(source),
              .half = iccp_alloc_zero(memory, source->features->n_places, 2),
              .inner = iccp_alloc_zero(memory, map->n_vertices, 1),
              .is_met = iccp_alloc_zero(memory, map->n_vertices, 1)};
    const bool is_there = vertex != NULL && r.half != NULL && r.inner != NULL && r.is_met != NULL;
    *follows = is_there && iccp_plmap_find_vertices(map, vertex) && follow(&r);
    for (size_t v = 0; *follows && v < map->n_vertices; ++v)
        *follows = map->fixed[v] == ICCP_FREE || iccp_plmap_is_at_place(map, v, source, target);
    iccp_free(memory, vertex);
    iccp_free(memory, r.half);
    iccp_free(memory, r.inner);
    iccp_free(memory, r.is_met);
    return is_there ? ICC_OK : ICC_ERR_MEMORY;
}
