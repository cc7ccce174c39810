/* Finds how close control points are to each other, and meshes a box around them. */
#include "fit/spline/frame_mesh.h"

#include "base/minmax.h"
#include "math/vec.h"

#include <string.h>

static void find_box(iccp_frame_region *r, const double *lower, const double *upper)
{
    for (size_t k = 0; k < 2; ++k) {
        r->lower[k] = lower != NULL ? lower[k] : r->points[k];
        r->upper[k] = upper != NULL ? upper[k] : r->points[k];
        for (size_t i = 0; i < r->n; ++i) {
            r->lower[k] = iccp_min(r->lower[k], r->points[2 * i + k]);
            r->upper[k] = iccp_max(r->upper[k], r->points[2 * i + k]);
        }
    }
    r->size = iccp_max(r->upper[0] - r->lower[0], r->upper[1] - r->lower[1]);
    if (!(r->size > 0))
        r->size = 1;
}

/* Adds the corners of a larger box to the points, so that they do not lie on one line. */
static void add_corners(const iccp_frame_region *r, double *points)
{
    memcpy(points, r->points, 2 * r->n * sizeof *points);
    for (size_t k = 0; k < 4; ++k) {
        points[2 * (r->n + k)] = k % 2 == 0 ? r->lower[0] - r->size : r->upper[0] + r->size;
        points[2 * (r->n + k) + 1] = k < 2 ? r->lower[1] - r->size : r->upper[1] + r->size;
    }
}

/* The nearest point is a neighbour in the Delaunay triangulation. */
static icc_status find_spacings(iccp_frame_region *r, const iccp_env *env)
{
    iccp_box_mesh mesh = {.memory = env->memory, .n_vertices = r->n + 4};
    mesh.points = iccp_alloc(&env->memory, r->n + 4, 2 * sizeof *mesh.points);
    if (mesh.points == NULL)
        return ICC_ERR_MEMORY;
    add_corners(r, mesh.points);
    const icc_status status = iccp_box_mesh_triangulate(&mesh, r->walls, env);
    if (status != ICC_OK)
        return status;
    for (size_t i = 0; i < r->n; ++i)
        r->spacing[i] = r->size;
    for (size_t c = 0; c < 3 * mesh.n_triangles; ++c) {
        const uint32_t a = mesh.triangles[c], b = mesh.triangles[c % 3 == 2 ? c - 2 : c + 1];
        const double d =
            iccp_vec_distance(2, mesh.points + 2 * (size_t)a, mesh.points + 2 * (size_t)b) *
            (iccp_edge_set_has(r->walls, a, b) ? 2 : 1);
        if (a < r->n)
            r->spacing[a] = iccp_min(r->spacing[a], d);
        if (b < r->n)
            r->spacing[b] = iccp_min(r->spacing[b], d);
    }
    iccp_box_mesh_free(&mesh);
    return ICC_OK;
}

icc_status iccp_frame_region_create(iccp_frame_region *region, size_t n, const double *points,
                                    const iccp_edge_set *walls, const double *lower,
                                    const double *upper, const iccp_env *env)
{
    *region = (iccp_frame_region){.n = n, .points = points, .walls = walls};
    find_box(region, lower, upper);
    region->spacing = iccp_alloc(&env->memory, n, sizeof *region->spacing);
    const icc_status status = region->spacing != NULL ? find_spacings(region, env) : ICC_ERR_MEMORY;
    if (status != ICC_OK) {
        iccp_free(&env->memory, region->spacing);
        region->spacing = NULL;
    }
    return status;
}

icc_status iccp_frame_mesh(iccp_box_mesh *mesh, const iccp_frame_region *region, double margin,
                           double across, double least, const iccp_env *env)
{
    const double largest = region->size / across, add = margin * region->size;
    const double lower[2] = {region->lower[0] - add, region->lower[1] - add};
    const double upper[2] = {region->upper[0] + add, region->upper[1] + add};
    double *width = iccp_alloc(&env->memory, region->n, sizeof *width);
    if (width == NULL)
        return ICC_ERR_MEMORY;
    for (size_t i = 0; i < region->n; ++i)
        width[i] = iccp_min(largest, iccp_max(least * largest, region->spacing[i]));
    const iccp_graded_box box = {.lower = lower,
                                 .upper = upper,
                                 .core_lower = region->lower,
                                 .core_upper = region->upper,
                                 .n = region->n,
                                 .points = region->points,
                                 .width = width,
                                 .largest = largest,
                                 .walls = region->walls};
    const icc_status status = iccp_graded_box_mesh(mesh, &box, env);
    iccp_free(&env->memory, width);
    return status;
}
