#include "map/outline.h"

#include "domain/polygon.h"

#include <string.h>

/* Follows next[v], the boundary vertex after boundary vertex v, from `first`, over n edges. False unless
 * they form one ring, which `ring` then lists. */
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

icc_status iccp_outline_check(const iccp_corners *corners, size_t n_vertices, const double *before,
                              const double *after, const iccp_env *env)
{
    uint32_t *next = iccp_alloc(&env->memory, n_vertices, sizeof *next);
    uint32_t *ring = iccp_alloc(&env->memory, n_vertices, sizeof *ring);
    icc_status status = next != NULL && ring != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        const size_t n = boundary_ring(corners, n_vertices, next, ring);
        status = n > 0 ? iccp_polygon_check_points(n, before, ring, env) : ICC_ERR_BOUNDARY;
        if (status == ICC_OK)
            status = iccp_polygon_check_points(n, after, ring, env);
    }
    iccp_free(&env->memory, next);
    iccp_free(&env->memory, ring);
    return status;
}
