/* Checks of triangles that a caller gives. */
#include "mesh/given_triangles.h"

#include "base/error.h"
#include "math/predicates.h"

#include <string.h>

static icc_status orient(uint32_t *to, size_t t, const uint32_t *from, size_t n_vertices,
                         const double *points, icc_error *err)
{
    for (size_t k = 0; k < 3; ++k)
        if (from[k] >= n_vertices)
            return iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)t,
                                "triangle %zu lists vertex %lu; there are %zu vertices", t,
                                (unsigned long)from[k], n_vertices);
    const int sign = iccp_orient2d(points + 2 * (size_t)from[0], points + 2 * (size_t)from[1],
                                   points + 2 * (size_t)from[2]);
    to[0] = from[0];
    to[1] = from[sign < 0 ? 2 : 1];
    to[2] = from[sign < 0 ? 1 : 2];
    return sign != 0 ? ICC_OK
                     : iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_SIMPLEX, (int64_t)t,
                                    "triangle %zu has no area", t);
}

icc_status iccp_orient_triangles(uint32_t *to, size_t n, const uint32_t *triangles,
                                 size_t n_vertices, const double *points, icc_error *err)
{
    icc_status status = ICC_OK;
    for (size_t t = 0; status == ICC_OK && t < n; ++t)
        status = orient(to + 3 * t, t, triangles + 3 * t, n_vertices, points, err);
    return status;
}

icc_status iccp_check_used(size_t n_vertices, size_t n, const uint32_t *triangles,
                           const iccp_env *env, icc_error *err)
{
    uint8_t *is_used = iccp_alloc_zero(&env->memory, n_vertices, 1);
    if (is_used == NULL)
        return ICC_ERR_MEMORY;
    for (size_t c = 0; c < 3 * n; ++c)
        is_used[triangles[c]] = 1;
    size_t v = 0;
    while (v < n_vertices && is_used[v])
        ++v;
    iccp_free(&env->memory, is_used);
    return v == n_vertices ? ICC_OK
                           : iccp_fail_at(err, ICC_ERR_BOUNDARY, ICC_ITEM_VERTEX, (int64_t)v,
                                          "vertex %zu belongs to no triangle", v);
}

/* Walks from triangle to triangle across edges. */
static icc_status check_pieces(const iccp_corners *c, const iccp_env *env, icc_error *err)
{
    const size_t n = c->n_triangles;
    uint32_t *list = iccp_alloc(&env->memory, n, sizeof *list);
    uint8_t *is_met = iccp_alloc_zero(&env->memory, n, 1);
    size_t n_met = 0;
    icc_status status = list != NULL && is_met != NULL ? ICC_OK : ICC_ERR_MEMORY;
    if (status == ICC_OK) {
        list[n_met++] = 0;
        is_met[0] = 1;
    }
    for (size_t i = 0; i < n_met; ++i)
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t twin = c->twin[3 * (size_t)list[i] + k];
            if (twin == ICCP_NO_NEIGHBOUR || is_met[twin / 3])
                continue;
            is_met[twin / 3] = 1;
            list[n_met++] = twin / 3;
        }
    iccp_free(&env->memory, list);
    iccp_free(&env->memory, is_met);
    return status == ICC_OK && n_met < n
               ? iccp_fail(err, ICC_ERR_TOPOLOGY, "the mesh is not in one piece")
               : status;
}

icc_status iccp_link_triangles(iccp_corners *corners, size_t n_vertices, uint32_t *next,
                               const iccp_env *env, icc_error *err)
{
    bool is_manifold = false;
    const icc_status status = iccp_find_twins(corners, n_vertices, &is_manifold, env);
    if (status != ICC_OK)
        return status;
    if (!is_manifold)
        return iccp_fail(err, ICC_ERR_BOUNDARY,
                         "an edge belongs to two triangles on the same side, or a triangle lists a "
                         "vertex twice");
    return iccp_link_boundary(corners, n_vertices, next)
               ? check_pieces(corners, env, err)
               : iccp_fail(err, ICC_ERR_BOUNDARY, "two parts of the boundary share a vertex");
}
