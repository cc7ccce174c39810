/* Based on: V. Kraevoy, A. Sheffer, Cross-Parameterization and Compatible Remeshing of 3D Models,
 * 2004, for a base that both surfaces have in common; here both are made coarse along its paths
 * until nothing else is left, it is drawn on the sphere once, and both grow from there, so that
 * every face is positive at any time. */
#include "surface/landmark_sphere.h"

#include "base/error.h"
#include "surface/decimate.h"
#include "surface/landmark_paths.h"
#include "surface/sphere.h"

#include <string.h>

/* Whether both surfaces, of which landmarks alone are left, have the same triangles. */
static bool is_same_base(const iccp_half_edges m[2], const iccp_split_surface s[2], size_t n,
                         const uint32_t *const vertices[2])
{
    for (size_t k = 0; k < n; ++k) {
        const uint32_t v = vertices[0][k], w = vertices[1][k];
        if (m[0].degree[v] != m[1].degree[w])
            return false;
        uint32_t h = m[0].out[v], g = m[1].out[w];
        const uint32_t first = s[0].holder[iccp_edge_end(&m[0], h)];
        uint32_t turns = 0;
        while (s[1].holder[iccp_edge_end(&m[1], g)] != first && turns++ < m[1].degree[w])
            g = iccp_edge_turn(&m[1], g);
        for (uint32_t i = 0; i < m[0].degree[v]; ++i) {
            if (s[0].holder[iccp_edge_end(&m[0], h)] != s[1].holder[iccp_edge_end(&m[1], g)])
                return false;
            h = iccp_edge_turn(&m[0], h);
            g = iccp_edge_turn(&m[1], g);
        }
    }
    return true;
}

static icc_status shrink(iccp_half_edges m[2], double scale[2], iccp_split_surface s[2], size_t n,
                         const uint32_t (*ends)[2], const uint8_t *joined, const iccp_env *env,
                         icc_error *err)
{
    for (int side = 0; side < 2; ++side) {
        const iccp_env part = iccp_part(env, NULL, 0.5 * side, 0.5 * side + 0.5);
        const iccp_decimate_web web = {s[side].holder, s[side].path, n, ends, joined};
        icc_status status = iccp_half_edges_create(&m[side], s[side].n_vertices, s[side].n_faces,
                                                   s[side].origin, env, err);
        if (status != ICC_OK)
            return status;
        scale[side] = iccp_sphere_scale(&m[side], s[side].x);
        status = iccp_decimate_along(&m[side], s[side].x, &web, &part);
        if (status == ICC_ERR_RESOLUTION)
            return iccp_fail(err, status, "a surface cannot be shrunk to its landmarks");
        if (status != ICC_OK)
            return iccp_explain(err, status);
    }
    return ICC_OK;
}

/* The base is drawn by the first surface, and both grow from it. */
static icc_status grow(double *const directions[2], iccp_half_edges m[2], const double scale[2],
                       const iccp_split_surface s[2], size_t n, const uint32_t *const vertices[2],
                       uint8_t *is_fixed, const iccp_env *env, icc_error *err)
{
    iccp_env parts[3];
    iccp_split(parts, 3, (const double[]){1, (double)s[0].n_vertices, (double)s[1].n_vertices},
               env);
    icc_status status = iccp_explain(err, iccp_decimate(&m[0], s[0].x, 4, env));
    if (status == ICC_OK)
        status = iccp_sphere_grow(directions[0], &m[0], s[0].x, scale[0], NULL, n, &parts[0], err);
    for (size_t k = 0; k < n && status == ICC_OK; ++k)
        memcpy(directions[1] + 3 * (size_t)vertices[1][k],
               directions[0] + 3 * (size_t)vertices[0][k], 3 * sizeof(double));
    for (int side = 0; side < 2 && status == ICC_OK; ++side) {
        memset(is_fixed, 0, m[side].n_vertices);
        for (size_t k = 0; k < n; ++k)
            is_fixed[vertices[side][k]] = 1;
        status = iccp_sphere_grow(directions[side], &m[side], s[side].x, scale[side], is_fixed,
                                  m[side].n_left + m[side].n_collapsed, &parts[1 + side], err);
    }
    return status;
}

icc_status iccp_landmark_sphere_draw(double *directions[2], iccp_half_edges m[2],
                                     iccp_split_surface s[2], size_t n,
                                     const uint32_t *const vertices[2], const iccp_env *env,
                                     icc_error *err)
{
    const iccp_memory *const memory = &env->memory;
    iccp_env parts[3];
    double scale[2];
    uint8_t *is_fixed = NULL;
    iccp_split(parts, 3, (const double[]){1, 1, 4}, env);
    uint32_t(*const ends)[2] = iccp_alloc(memory, 3 * n - 6, sizeof *ends);
    uint8_t *const joined = iccp_alloc(memory, n * n, sizeof *joined);
    icc_status status = ICC_ERR_MEMORY;
    if (ends != NULL && joined != NULL)
        status = iccp_landmark_paths(s, n, vertices, ends, joined, &parts[0]);
    status = status == ICC_ERR_RESOLUTION
                 ? iccp_fail(err, status,
                             "the paths between landmarks take too many vertices: these are not in "
                             "corresponding places")
                 : iccp_explain(err, status);
    if (status == ICC_OK)
        status = shrink(m, scale, s, n, (const uint32_t(*)[2])ends, joined, &parts[1], err);
    if (status == ICC_OK && !is_same_base(m, s, n, vertices))
        status = iccp_fail(err, ICC_ERR_CERTIFICATE,
                           "two surfaces that are shrunk to their landmarks differ");
    if (status == ICC_OK) {
        for (int side = 0; side < 2; ++side)
            directions[side] =
                iccp_alloc_zero(memory, s[side].n_vertices, 3 * sizeof *directions[side]);
        is_fixed = iccp_alloc(memory, s[0].n_vertices + s[1].n_vertices, sizeof *is_fixed);
        status = directions[0] != NULL && directions[1] != NULL && is_fixed != NULL
                     ? grow(directions, m, scale, s, n, vertices, is_fixed, &parts[2], err)
                     : iccp_fail_memory(err);
    }
    iccp_free(memory, ends);
    iccp_free(memory, joined);
    iccp_free(memory, is_fixed);
    return status;
}
