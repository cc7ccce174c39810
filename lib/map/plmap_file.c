#include "map/plmap_file.h"

#include "domain/domain_file.h"

#include <math.h>

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

/* Fixed are the vertices of the boundary. */
static void find_boundary(iccp_plmap *map, const icc_domain *source)
{
    for (size_t v = 0; v < map->n_vertices; ++v) {
        map->fixed[v] = 0;
        map->facet[v] = 0;
        map->along[v] = 0;
    }
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c)
        if (map->corners.twin[c] == ICCP_NO_NEIGHBOUR)
            map->fixed[map->corners.vertex[iccp_after(c)]] = iccp_plmap_sense(source);
}

/* ---- where the boundary is ---- */

static bool is_near(const icc_domain *domain, uint32_t facet, double along, const double *point)
{
    const double bary[2] = {1 - along, along};
    double wanted[2];
    iccp_domain_facet_point(domain, facet, bary, wanted);
    return fabs(point[0] - wanted[0]) <= domain->band.tolerance &&
           fabs(point[1] - wanted[1]) <= domain->band.tolerance;
}

/* Where facets start, counter-clockwise. */
static bool starts_facet(const iccp_plmap *map, uint32_t v)
{
    return map->fixed[v] == ICCP_ALONG ? !(map->along[v] > 0) : !(map->along[v] < 1);
}

/* Whether edge a b of the boundary goes on along a facet, or to the start of the next one. */
static bool goes_on(const iccp_plmap *map, const icc_domain *domain, uint32_t a, uint32_t b)
{
    const size_t f = map->facet[a], g = map->facet[b], forward = map->fixed[a] == ICCP_ALONG;
    if (starts_facet(map, b))
        return domain->facets[2 * f + forward] == domain->facets[2 * g + 1 - forward];
    const double ahead = map->along[b] - map->along[a];
    return f == g && (forward ? ahead : -ahead) >= 0;
}

/* Once, since to the certificate it must be one ring, and simple. */
static bool follows_facets(const iccp_plmap *map, const icc_domain *source,
                           const icc_domain *target)
{
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c) {
        const uint32_t a = map->corners.vertex[iccp_after(c)];
        if (map->corners.twin[c] != ICCP_NO_NEIGHBOUR)
            continue;
        if (!goes_on(map, source, a, map->corners.vertex[iccp_before(c)]) ||
            !is_near(source, map->facet[a], map->along[a], map->points + 2 * (size_t)a) ||
            !is_near(target, map->facet[a], map->along[a], map->images + 2 * (size_t)a))
            return false;
    }
    return true;
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
        if (map->fixed[v]) {
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
    const icc_status status = link_triangles(map, env);
    if (status != ICC_OK)
        return status;
    find_boundary(map, source);
    visit_boundary(b, map, source->n_facets);
    return b->status == ICC_OK && follows_facets(map, source, target) ? ICC_OK : ICC_ERR_FORMAT;
}

icc_status iccp_plmap_visit(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                            const icc_domain *target, const iccp_env *env)
{
    size_t n_vertices = map->n_vertices, n_triangles = map->corners.n_triangles;
    iccp_blob_count(b, 4 * ICCP_F64, &n_vertices);
    iccp_blob_count(b, 3 * ICCP_U32, &n_triangles);
    if (!b->reads) {
        visit_vertices(b, map);
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
