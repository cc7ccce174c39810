/* Every triangle positive before and after, a disc by Euler's formula, and both boundaries simple:
 * then the map of the closed polygons is a homeomorphism (docs/theory.md, the mesh map). */
#include "map/plmap_certificate.h"

#include "base/error.h"
#include "domain/polygon_check.h"

#include <string.h>

/* Follows next[v], the boundary vertex after boundary vertex v, from `first`, over n edges. False
 * unless they form one ring, which `ring` then lists. */
static bool follow(const uint32_t *next, uint32_t first, size_t n, uint32_t *ring)
{
    uint32_t v = first;
    for (size_t k = 0; k < n; ++k) {
        if (k > 0 && v == first)
            return false;
        ring[k] = v;
        v = next[v];
    }
    return n >= 3 && v == first;
}

/* The boundary vertices in order; 0 unless they form one ring. */
static size_t boundary_ring(const iccp_corners *corners, size_t n_vertices, uint32_t *next,
                            uint32_t *ring)
{
    size_t n = 0;
    uint32_t first = 0;
    memset(next, 0xff, n_vertices * sizeof *next);
    for (uint32_t c = 0; c < 3 * corners->n_triangles; ++c)
        if (corners->twin[c] == ICCP_NO_NEIGHBOUR) {
            first = corners->vertex[iccp_after(c)];
            if (next[first] != UINT32_MAX)
                return 0;
            next[first] = corners->vertex[iccp_before(c)];
            ++n;
        }
    return n > 0 && follow(next, first, n, ring) ? n : 0;
}

/* ICC_ERR_BOUNDARY unless the half-edges without twins form one polygon that is simple before and
 * after the map. */
static icc_status check_outline(const iccp_plmap *map, const iccp_env *env)
{
    uint32_t *next = iccp_alloc(&env->memory, map->n_vertices, sizeof *next);
    uint32_t *ring = iccp_alloc(&env->memory, map->n_vertices, sizeof *ring);
    icc_status status = next != NULL && ring != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        const size_t n = boundary_ring(&map->corners, map->n_vertices, next, ring);
        status = n > 0 ? iccp_polygon_check_points(n, map->points, ring, env) : ICC_ERR_BOUNDARY;
        if (status == ICC_OK)
            status = iccp_polygon_check_points(n, map->images, ring, env);
    }
    iccp_free(&env->memory, next);
    iccp_free(&env->memory, ring);
    return status;
}

icc_status iccp_plmap_certify(const iccp_plmap *map, const iccp_env *env, icc_error *err)
{
    size_t n_faults = 0, n_open = 0;
    const size_t n_triangles = map->corners.n_triangles;
    for (uint32_t t = 0; t < n_triangles; ++t)
        n_faults += !iccp_plmap_positive_point(map, t) || !iccp_plmap_positive_image(map, t);
    for (uint32_t c = 0; c < 3 * n_triangles; ++c) {
        const uint32_t twin = map->corners.twin[c];
        n_open += twin == ICCP_NO_NEIGHBOUR;
        if (twin != ICCP_NO_NEIGHBOUR)
            n_faults +=
                map->corners.twin[twin] != c ||
                map->corners.vertex[iccp_after(twin)] != map->corners.vertex[iccp_before(c)] ||
                map->corners.vertex[iccp_before(twin)] != map->corners.vertex[iccp_after(c)];
    }
    if (n_faults > 0 || 2 * map->n_vertices != n_triangles + n_open + 2)
        return iccp_fail(err, ICC_ERR_CERTIFICATE, "the mesh map cannot be certified: %zu faults",
                         n_faults);
    const icc_status status = check_outline(map, env);
    return status == ICC_ERR_BOUNDARY
               ? iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "the boundary of the mesh or of its image is not simple")
               : status;
}
