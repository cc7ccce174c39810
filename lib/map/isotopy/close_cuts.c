/* Closes the cuts of an overlay. Two edges of the cut polygon that are partners become one edge.
 * Their corners become common vertices, which are found with disjoint sets (base/sets.h). */
#include "map/isotopy/close_cuts.h"

#include "base/sets.h"

#include <string.h>

static const uint32_t NONE = ICCP_NO_NEIGHBOUR;

/* Joins the corners at both ends of partner edges. The smallest number in each set stands for the
 * set. */
static void join_corners(uint32_t *leader, const iccp_cut_polygon *p)
{
    iccp_sets_begin(leader, p->n);
    for (uint32_t i = 0; i < p->n; ++i) {
        const uint32_t j = p->partner[i];
        if (j == NONE)
            continue;
        iccp_sets_join(leader, i, j + 1 < p->n ? j + 1 : 0);
        iccp_sets_join(leader, i + 1 < p->n ? i + 1 : 0, j);
    }
}

/* Sets number[i] to the vertex of the map for vertex i of the overlay. Returns the number of
 * vertices of the map. */
static uint32_t number_vertices(uint32_t *number, uint32_t *leader, uint32_t n, size_t n_vertices)
{
    uint32_t n_left = 0;
    for (uint32_t i = 0; i < n_vertices; ++i)
        number[i] = i >= n || iccp_sets_leader(leader, i) == i
                        ? n_left++
                        : number[iccp_sets_leader(leader, i)];
    return n_left;
}

/* Fills in the map's triangles. `facing` is work space: for each edge of the polygon, the corner
 * that faces it. */
static void join_triangles(iccp_plmap *map, const iccp_overlay *o, const iccp_cut_polygon *p,
                           const uint32_t *number, uint32_t *facing)
{
    iccp_corners *c = &map->corners;
    const size_t n_corners = 3 * c->n_triangles;
    for (uint32_t x = 0; x < n_corners; ++x) {
        c->vertex[x] = number[o->corners.vertex[x]];
        c->twin[x] = o->corners.twin[x];
        if (o->corners.twin[x] == NONE)
            facing[o->corners.vertex[iccp_after(x)]] = x;
    }
    for (uint32_t i = 0; i < p->n; ++i)
        if (p->partner[i] != NONE)
            c->twin[facing[i]] = facing[p->partner[i]];
}

/* Records the place of a vertex on a line or a point. The polygon's edge at such a vertex does not
 * tell the facet. */
static void place_feature(iccp_plmap *map, uint32_t v, const iccp_feature *f, uint32_t vertex)
{
    const uint32_t place = vertex - f->first;
    const bool is_last = f->kind == ICC_FEATURE_LINE && place + 1 == f->n;
    map->fixed[v] = f->kind != ICC_FEATURE_LINE ? ICCP_ON_POINT
                    : place == 0                ? ICCP_LINE_BEGIN
                                                : ICCP_ON_LINE;
    map->facet[v] = f->first_facet + place - is_last;
    map->along[v] = is_last ? 1 : 0;
}

/* Records the facet of a ring for vertex v. The polygon's edge from a to b lies on the ring and has
 * the inside on its left. */
static void place_on_ring(iccp_plmap *map, uint32_t v, const icc_domain *domain,
                          const iccp_domain_pair *domains, uint32_t a, uint32_t b)
{
    const uint32_t component = domains->component[a];
    const iccp_feature *f = component > 0 ? &domain->features->item[component - 1] : NULL;
    const uint32_t first = f != NULL ? f->first : 0;
    const uint32_t first_facet = f != NULL ? f->first_facet : 0;
    const bool is_along = domain->facets[2 * (size_t)(first_facet + a - first) + 1] == b;
    map->fixed[v] = is_along ? ICCP_ALONG : ICCP_AGAINST;
    map->facet[v] = first_facet + (is_along ? a : b) - first;
    map->along[v] = is_along ? 0 : 1;
}

static void place_vertices(iccp_plmap *map, const iccp_overlay *o, const iccp_cut_polygon *p,
                           const iccp_domain_pair *domains, const uint32_t *number)
{
    const icc_domain *domain = domains->domain[0];
    memset(map->fixed, 0, map->n_vertices);
    memset(map->facet, 0, map->n_vertices * sizeof *map->facet);
    memset(map->along, 0, map->n_vertices * sizeof *map->along);
    for (size_t i = 0; i < o->n_vertices; ++i) {
        memcpy(map->points + 2 * (size_t)number[i], o->points + 2 * i, 2 * sizeof(double));
        memcpy(map->images + 2 * (size_t)number[i], o->images + 2 * i, 2 * sizeof(double));
    }
    for (uint32_t i = 0; i < p->n; ++i) {
        const uint32_t a = p->vertex[i], b = p->vertex[i + 1 < p->n ? i + 1 : 0];
        const uint32_t component = a < domains->n ? domains->component[a] : 0;
        if (p->partner[i] == NONE)
            place_on_ring(map, number[i], domain, domains, a, b);
        else if (a < domains->n && component > 0 &&
                 domain->features->item[component - 1].kind != ICC_FEATURE_HOLE)
            place_feature(map, number[i], &domain->features->item[component - 1], a);
    }
}

icc_status iccp_close_cuts(iccp_plmap *map, const iccp_overlay *overlay,
                           const iccp_cut_polygon *polygon, const iccp_domain_pair *domains,
                           const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    uint32_t *leader = iccp_alloc(memory, polygon->n, sizeof *leader);
    uint32_t *number = iccp_alloc(memory, overlay->n_vertices, sizeof *number);
    icc_status status = ICC_ERR_MEMORY;
    *map = (iccp_plmap){.memory = *memory};
    if (leader != NULL && number != NULL) {
        join_corners(leader, polygon);
        const uint32_t n = number_vertices(number, leader, polygon->n, overlay->n_vertices);
        status = iccp_plmap_begin(map, n, overlay->corners.n_triangles, 1 / domains->scale, memory);
    }
    if (status == ICC_OK) {
        place_vertices(map, overlay, polygon, domains, number);
        join_triangles(map, overlay, polygon, number, leader);
    }
    iccp_free(memory, leader);
    iccp_free(memory, number);
    return status;
}
