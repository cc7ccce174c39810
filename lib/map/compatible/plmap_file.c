/* Reads and writes the mesh of a plane map (docs/reference/formats.md). The mesh that is read must
 * be a manifold. Without features, its boundary must run along that of both domains. With features,
 * the certificate checks the boundary and the lines (map/compatible/network_rows.h). */
#include "map/compatible/plmap_file.h"

#include "domain/domain_file.h"
#include "domain/features.h"
#include "map/compatible/network_rows.h"

#include <math.h>
#include <string.h>

/* Twins follow from the triangles. */
static icc_status link_triangles(iccp_plmap *map, const iccp_env *env)
{
    bool is_manifold = false;
    for (size_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.vertex[c] >= map->n_vertices)
            return ICC_ERR_FORMAT;
    const icc_status status = iccp_find_twins(&map->corners, map->n_vertices, &is_manifold, env);
    return status != ICC_OK || is_manifold ? status : ICC_ERR_FORMAT;
}

/* Fixes the vertices of the boundary. */
static void find_boundary(iccp_plmap *map, const icc_domain *source)
{
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.twin[c] == ICCP_NO_NEIGHBOUR)
            map->fixed[map->corners.vertex[iccp_after(c)]] = iccp_plmap_sense(source);
}

/* ---- where the boundary is ---- */

/* Whether a vertex lies where a facet starts, counter-clockwise. */
static bool starts_facet(const iccp_plmap *map, uint32_t v)
{
    return map->fixed[v] == ICCP_ALONG ? !(map->along[v] > 0) : !(map->along[v] < 1);
}

/* Whether edge a b of the boundary goes on along a's facet, or ends at the start of the next
 * one. */
static bool goes_on(const iccp_plmap *map, const icc_domain *domain, uint32_t a, uint32_t b)
{
    const size_t f = map->facet[a], g = map->facet[b], forward = map->fixed[a] == ICCP_ALONG;
    if (starts_facet(map, b))
        return domain->facets[2 * f + forward] == domain->facets[2 * g + 1 - forward];
    const double ahead = map->along[b] - map->along[a];
    return f == g && (forward ? ahead : -ahead) >= 0;
}

/* Whether the boundary goes along the facets of both domains. It goes around only once, because the
 * certificate demands simple rings. */
static bool follows_facets(const iccp_plmap *map, const icc_domain *source,
                           const icc_domain *target)
{
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c) {
        const uint32_t a = map->corners.vertex[iccp_after(c)];
        if (map->corners.twin[c] != ICCP_NO_NEIGHBOUR)
            continue;
        if (!goes_on(map, source, a, map->corners.vertex[iccp_before(c)]) ||
            !iccp_plmap_is_at_place(map, a, source, target))
            return false;
    }
    return true;
}

/* ---- vertices on a network ---- */

/* Reads one vertex after another, with its facet and its place on it. `first_facet`: the smallest
 * facet that may come. */
static void read_fixed(iccp_blob *b, iccp_plmap *map, size_t first_facet)
{
    size_t n = 0;
    uint32_t v = 0;
    iccp_blob_count(b, 2 * ICCP_U32 + ICCP_F64, &n);
    for (size_t i = 0; i < n && b->status == ICC_OK; ++i) {
        const uint32_t least = i == 0 ? 0 : v + 1;
        uint32_t facet = 0;
        double along = 0;
        iccp_blob_u32(b, 1, &v);
        iccp_blob_u32(b, 1, &facet);
        iccp_blob_f64(b, 1, &along);
        iccp_blob_require(b, v >= least && v < map->n_vertices && facet >= first_facet &&
                                 facet < map->featured->features->n_places && along >= 0 &&
                                 along <= 1);
        if (b->status != ICC_OK)
            return;
        iccp_blob_require(b, map->fixed[v] == ICCP_FREE);
        map->fixed[v] = ICCP_ON_NETWORK;
        map->facet[v] = facet;
        map->along[v] = along;
    }
}

static void write_fixed(iccp_blob *b, iccp_plmap *map)
{
    size_t n = 0;
    for (size_t v = 0; v < map->n_vertices; ++v)
        n += map->fixed[v] == ICCP_ON_NETWORK;
    iccp_blob_size(b, &n);
    for (uint32_t v = 0; v < map->n_vertices; ++v)
        if (map->fixed[v] == ICCP_ON_NETWORK) {
            uint32_t head[2] = {v, map->facet[v]};
            iccp_blob_u32(b, 2, head);
            iccp_blob_f64(b, 1, &map->along[v]);
        }
}

/* Puts vertices at ends of facets to the places of their nodes. Features did not touch when the
 * format did without networks. */
static void place_nodes(iccp_plmap *map)
{
    for (size_t v = 0; v < map->n_vertices; ++v) {
        if (map->fixed[v] == ICCP_FREE)
            continue;
        map->fixed[v] = ICCP_ON_NETWORK;
        if (!(map->along[v] > 0 && map->along[v] < 1))
            iccp_plmap_fix_node(
                map, v, map->featured->facets[2 * (size_t)map->facet[v] + (map->along[v] > 0)]);
    }
}

/* ---- all of it ---- */

static void visit_vertices(iccp_blob *b, iccp_plmap *map)
{
    iccp_blob_f64(b, 2 * map->n_vertices, map->points);
    iccp_blob_f64(b, 2 * map->n_vertices, map->images);
    iccp_blob_u32(b, 3 * map->corners.n_triangles, map->corners.vertex);
}

static void visit_boundary(iccp_blob *b, iccp_plmap *map, size_t n_facets)
{
    for (size_t v = 0; v < map->n_vertices; ++v)
        if (map->fixed[v] != ICCP_FREE) {
            iccp_blob_u32(b, 1, &map->facet[v]);
            iccp_blob_f64(b, 1, &map->along[v]);
            iccp_blob_require(b,
                              map->facet[v] < n_facets && map->along[v] >= 0 && map->along[v] <= 1);
        }
}

static icc_status read_rest(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                            const icc_domain *target, const iccp_env *env)
{
    const size_t n = 2 * map->n_vertices;
    visit_vertices(b, map);
    if (b->status != ICC_OK || !iccp_are_local(2, n, map->points) ||
        !iccp_are_local(2, n, map->images))
        return ICC_ERR_FORMAT;
    icc_status status = link_triangles(map, env);
    if (status != ICC_OK)
        return status;
    iccp_plmap_fix_none(map, source->features != NULL ? source : NULL);
    if (b->version < ICCP_VERSION_NETWORKS) {
        find_boundary(map, source);
        visit_boundary(b, map, source->n_facets);
    }
    if (b->status == ICC_OK && source->features != NULL) {
        read_fixed(b, map, b->version >= ICCP_VERSION_NETWORKS ? 0 : source->n_facets);
        if (b->version < ICCP_VERSION_NETWORKS)
            place_nodes(map);
    }
    return b->status == ICC_OK && (source->features != NULL || follows_facets(map, source, target))
               ? ICC_OK
               : ICC_ERR_FORMAT;
}

icc_status iccp_plmap_visit(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                            const icc_domain *target, const iccp_env *env)
{
    size_t n_vertices = map->n_vertices, n_triangles = map->corners.n_triangles;
    iccp_blob_count(b, 4 * ICCP_F64, &n_vertices);
    iccp_blob_count(b, 3 * ICCP_U32, &n_triangles);
    if (!b->reads) {
        visit_vertices(b, map);
        if (source->features != NULL)
            write_fixed(b, map);
        else
            visit_boundary(b, map, source->n_facets);
        return ICC_OK;
    }
    if (b->status != ICC_OK || n_triangles == 0 || 3 * (uint64_t)n_triangles >= UINT32_MAX)
        return ICC_ERR_FORMAT;
    icc_status status = iccp_plmap_begin(map, n_vertices, n_triangles,
                                         sqrt(target->measure / source->measure), &env->memory);
    if (status != ICC_OK)
        return status;
    status = read_rest(b, map, source, target, env);
    if (status != ICC_OK)
        iccp_plmap_free(map);
    return status;
}
