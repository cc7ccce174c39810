/* Checks the arguments of the triangulation of points in a polygon. */
#include "api/check.h"
#include "base/error.h"
#include "domain/domain.h"
#include "icc/stages.h"
#include "mesh/triangulate.h"

#include <math.h>

/* The corners of triangles also need numbers of 32 bits. */
static const size_t MAX_POINTS = UINT32_MAX / 16;

/* Converts the inner points to the polygon's local coordinates. Points within its bounding box
 * are shifted and scaled as exactly as its vertices (geometry/frame.h). */
static icc_status localise(double *local, const icc_domain *polygon, size_t n_points,
                           const double *points, icc_error *err)
{
    for (size_t i = polygon->n_vertices; i < n_points; ++i) {
        const double *p = points + 2 * i;
        if (!isfinite(p[0]) || !isfinite(p[1]))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "point %zu is not finite", i);
        iccp_frame_in(&polygon->frame, 2, p, local + 2 * i);
        for (int k = 0; k < 2; ++k)
            if (local[2 * i + (size_t)k] < polygon->lower[k] ||
                local[2 * i + (size_t)k] > polygon->upper[k])
                return iccp_fail_at(err, ICC_ERR_OUTSIDE, ICC_ITEM_POINT, (int64_t)i,
                                    "point %zu (%.17g, %.17g) is not inside the polygon", i, p[0],
                                    p[1]);
        if (!iccp_frame_holds(&polygon->frame, 2, p))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "point %zu (%.17g, %.17g): a coordinate is not 0, but less than "
                                "2^-200 of the largest one",
                                i, p[0], p[1]);
    }
    return ICC_OK;
}

static icc_status triangulate(const icc_domain *polygon, size_t n_points, const double *points,
                              uint32_t *triangles, const iccp_env *env, icc_error *err)
{
    double *local = iccp_alloc(&env->memory, n_points, 2 * sizeof *local);
    if (local == NULL)
        return iccp_fail_memory(err);
    for (size_t i = 0; i < 2 * polygon->n_vertices; ++i)
        local[i] = polygon->vertices[i];
    icc_status status = localise(local, polygon, n_points, points, err);
    if (status == ICC_OK)
        status = iccp_triangulate(polygon->n_vertices, n_points, local, triangles, env, err);
    iccp_free(&env->memory, local);
    return status;
}

icc_status icc_triangulate(size_t n_boundary, size_t n_points, const double *points,
                           uint32_t *triangles, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full_env;
    const char *missing = points == NULL ? "points" : triangles == NULL ? "triangles" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (n_boundary < 3 || n_points < n_boundary || n_points > MAX_POINTS)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "a polygon of %zu vertices among %zu points: at least 3 vertices, and at "
                         "most %zu points",
                         n_boundary, n_points, MAX_POINTS);
    icc_domain *polygon;
    status = iccp_domain_create(&polygon, 2, n_boundary, points, 0, NULL, &full_env, err);
    if (status == ICC_OK)
        status = triangulate(polygon, n_points, points, triangles, &full_env, err);
    iccp_domain_release(polygon);
    return iccp_explain(err, iccp_finish(&full_env, status));
}
