#include "map/outline.h"

#include <string.h>

bool iccp_outline_follow(const uint32_t *next, uint32_t first, size_t n, uint32_t *ring)
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

icc_status iccp_outline_check(const double *points, const uint32_t *ring, size_t n,
                              const iccp_env *env)
{
    iccp_ring copy = {.n = n};
    copy.points = iccp_alloc(&env->memory, n + 1, 2 * sizeof *copy.points);
    copy.vertex = iccp_alloc(&env->memory, n, sizeof *copy.vertex);
    copy.facet = iccp_alloc(&env->memory, n, sizeof *copy.facet);
    icc_status status = ICC_ERR_MEMORY;
    if (copy.points != NULL && copy.vertex != NULL && copy.facet != NULL) {
        for (uint32_t k = 0; k < n; ++k) {
            memcpy(copy.points + 2 * (size_t)k, points + 2 * (size_t)ring[k], 2 * sizeof *points);
            copy.vertex[k] = copy.facet[k] = k;
        }
        memcpy(copy.points + 2 * n, copy.points, 2 * sizeof *points);
        status = iccp_polygon_check(&copy, &iccp_frame_identity, env, NULL);
    }
    iccp_ring_free(&copy, &env->memory);
    return status;
}
