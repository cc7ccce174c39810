/* Reads and writes the mesh of a plane map (docs/reference/formats.md). The mesh that is read must
 * be a manifold, and its boundary and lines must run along those of both domains. */
#include "map/compatible/plmap_file.h"

#include "domain/domain_file.h"
#include "domain/features.h"

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
            !is_near(source, map->facet[a], map->along[a], map->points + 2 * (size_t)a) ||
            !is_near(target, map->facet[a], map->along[a], map->images + 2 * (size_t)a))
            return false;
    }
    return true;
}

/* ---- where lines and points are ---- */

/* Lists for each facet of a domain with features what a vertex on it is fixed to. For the first
 * segment of a line that is the vertex at its beginning. */
static void list_kinds(uint8_t *kind, const icc_domain *domain)
{
    const iccp_features *features = domain->features;
    memset(kind, iccp_plmap_sense(domain), features->n_outer);
    for (size_t i = 0; i < features->n; ++i) {
        const iccp_feature *f = &features->item[i];
        memset(kind + f->first_facet,
               f->kind == ICC_FEATURE_LINE    ? ICCP_ON_LINE
               : f->kind == ICC_FEATURE_POINT ? ICCP_ON_POINT
               : f->orientation > 0           ? ICCP_AGAINST
                                              : ICCP_ALONG,
               f->n_facets);
        if (f->kind == ICC_FEATURE_LINE)
            kind[f->first_facet] = ICCP_LINE_BEGIN;
    }
}

/* Whether a vertex may have this place on a facet. The end of a segment belongs to the next
 * segment, except for a line's last one. `kind`: from list_kinds(). */
static bool is_place(const uint8_t *kind, const icc_domain *domain, uint32_t facet, double along)
{
    const bool is_last = facet + 1 == domain->features->n_places || kind[facet + 1] != ICCP_ON_LINE;
    return kind[facet] == ICCP_ON_POINT ? !(along > 0) : along < 1 || is_last;
}

/* Whether the edges on lines lead from the beginning of each line to its end. One edge leaves each
 * vertex except the last, and one reaches each vertex except the first. `seen` is work space: 1 for
 * an edge that leaves a vertex, plus 2 for one that reaches it. */
static bool follows_lines(const iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                          uint8_t *seen)
{
    memset(seen, 0, map->n_vertices);
    for (uint32_t c = 0; c < 3 * map->corners.n_triangles; ++c) {
        const uint32_t a = map->corners.vertex[iccp_after(c)];
        const uint32_t b = map->corners.vertex[iccp_before(c)];
        uint32_t facet;
        double from, to;
        if (map->fixed[a] < ICCP_LINE_BEGIN || map->fixed[b] < ICCP_LINE_BEGIN ||
            !iccp_plmap_on_line(map, a, b, &facet, &from, &to) || from > to)
            continue;
        if ((seen[a] & 1) != 0 || (seen[b] & 2) != 0)
            return false;
        seen[a] |= 1;
        seen[b] |= 2;
    }
    for (size_t v = 0; v < map->n_vertices; ++v) {
        const uint8_t kind = map->fixed[v];
        const int leaves = (kind == ICCP_LINE_BEGIN || kind == ICCP_ON_LINE) && map->along[v] < 1;
        if (kind < ICCP_LINE_BEGIN)
            continue;
        if (seen[v] != leaves + (kind == ICCP_ON_LINE ? 2 : 0) ||
            !is_near(source, map->facet[v], map->along[v], map->points + 2 * v) ||
            !is_near(target, map->facet[v], map->along[v], map->images + 2 * v))
            return false;
    }
    return true;
}

/* Reads the fixed vertices inside. `kind`: from list_kinds(). */
static void read_inner(iccp_blob *b, iccp_plmap *map, const icc_domain *source, const uint8_t *kind)
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
        iccp_blob_require(b, v >= least && v < map->n_vertices && facet >= source->n_facets &&
                                 facet < source->features->n_places && along >= 0 && along <= 1 &&
                                 is_place(kind, source, facet, along));
        if (b->status != ICC_OK)
            return;
        iccp_blob_require(b, map->fixed[v] == ICCP_FREE);
        map->fixed[v] = kind[facet] == ICCP_LINE_BEGIN && along > 0 ? ICCP_ON_LINE : kind[facet];
        map->facet[v] = facet;
        map->along[v] = along;
    }
}

static void write_inner(iccp_blob *b, iccp_plmap *map)
{
    size_t n = 0;
    for (size_t v = 0; v < map->n_vertices; ++v)
        n += map->fixed[v] >= ICCP_LINE_BEGIN;
    iccp_blob_size(b, &n);
    for (uint32_t v = 0; v < map->n_vertices; ++v)
        if (map->fixed[v] >= ICCP_LINE_BEGIN) {
            uint32_t head[2] = {v, map->facet[v]};
            iccp_blob_u32(b, 2, head);
            iccp_blob_f64(b, 1, &map->along[v]);
        }
}

/* Reads what the vertices inside are fixed to, once those of the boundary have their facets. */
static icc_status read_features(iccp_blob *b, iccp_plmap *map, const icc_domain *source,
                                const icc_domain *target, const iccp_env *env)
{
    const size_t n_places = source->features->n_places;
    uint8_t *kind = iccp_alloc(&env->memory, n_places, sizeof *kind);
    uint8_t *seen = iccp_alloc(&env->memory, map->n_vertices, sizeof *seen);
    uint32_t *vertex = iccp_alloc(&env->memory, source->n_vertices, sizeof *vertex);
    icc_status status = ICC_ERR_MEMORY;
    if (kind != NULL && seen != NULL && vertex != NULL) {
        list_kinds(kind, source);
        for (size_t v = 0; v < map->n_vertices; ++v)
            if (map->fixed[v] != ICCP_FREE)
                map->fixed[v] = kind[map->facet[v]];
        read_inner(b, map, source, kind);
        status = b->status == ICC_OK && iccp_plmap_find_vertices(map, source, vertex) &&
                         follows_lines(map, source, target, seen)
                     ? ICC_OK
                     : ICC_ERR_FORMAT;
    }
    iccp_free(&env->memory, kind);
    iccp_free(&env->memory, seen);
    iccp_free(&env->memory, vertex);
    return status;
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
        if (map->fixed[v] == ICCP_ALONG || map->fixed[v] == ICCP_AGAINST) {
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
    find_boundary(map, source);
    visit_boundary(b, map, source->n_facets);
    if (b->status == ICC_OK && source->features != NULL)
        status = read_features(b, map, source, target, env);
    if (status != ICC_OK)
        return status;
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
        if (source->features != NULL)
            write_inner(b, map);
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
