#include "map/compatible.h"

#include "map/overlay.h"

/* By diagonals alone; `room`: 6 (n - 2). */
static icc_status triangulate(iccp_ngon *polygon, size_t n, const double *points, uint32_t *room,
                              const iccp_env *env)
{
    *polygon = (iccp_ngon){points, room, room + 3 * (n - 2)};
    return iccp_triangulate_mesh(n, n, points, room, room + 3 * (n - 2), env, NULL);
}

icc_status iccp_compatible_create(iccp_plmap *map, const iccp_planar *base,
                                  const icc_domain *source, const double *images, double stretch,
                                  const iccp_env *env)
{
    const size_t n = base->n_boundary;
    iccp_ngon before, after;
    iccp_overlay overlay = {.memory = env->memory};
    uint32_t *room = iccp_alloc(&env->memory, n - 2, 12 * sizeof *room);
    icc_status status = ICC_ERR_MEMORY;
    if (room != NULL)
        status = triangulate(&before, n, base->points, room, env);
    if (status == ICC_OK)
        status = triangulate(&after, n, images, room + 6 * (n - 2), env);
    if (status == ICC_OK)
        status = iccp_overlay_create(&overlay, (uint32_t)n, &before, &after, env);
    if (status == ICC_OK) {
        iccp_planar mesh = *base;
        mesh.n_vertices = overlay.n_vertices;
        mesh.n_triangles = overlay.corners.n_triangles;
        mesh.points = overlay.points;
        mesh.triangles = overlay.corners.vertex;
        mesh.twins = overlay.corners.twin;
        status = iccp_plmap_create(map, &mesh, source, overlay.images, stretch, &env->memory);
    }
    iccp_overlay_free(&overlay);
    iccp_free(&env->memory, room);
    return status;
}
