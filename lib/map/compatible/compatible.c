/* Triangulates two polygons by diagonals and overlays them (overlay.h). */
#include "map/compatible/compatible.h"

/* Triangulates a polygon by diagonals alone. `room`: 6 (n - 2) numbers. ICC_ERR_BOUNDARY if the
 * polygon is clockwise. */
static icc_status triangulate(iccp_ngon *polygon, size_t n, const double *points, uint32_t *room,
                              const iccp_env *env)
{
    uint32_t *const twins = room + 3 * (n - 2), c = 0;
    *polygon = (iccp_ngon){points, room, twins};
    const icc_status status = iccp_triangulate_mesh(n, n, points, room, twins, env, NULL);
    if (status != ICC_OK)
        return status;
    while (twins[c] != ICCP_NO_NEIGHBOUR)
        ++c;
    return (room[iccp_after(c)] + 1) % n == room[iccp_before(c)] ? ICC_OK : ICC_ERR_BOUNDARY;
}

icc_status iccp_compatible_overlay(iccp_overlay *overlay, size_t n, const double *points,
                                   const double *images, const iccp_env *env)
{
    iccp_ngon before, after;
    uint32_t *room = iccp_alloc(&env->memory, n - 2, 12 * sizeof *room);
    icc_status status = room != NULL ? ICC_OK : ICC_ERR_MEMORY;
    *overlay = (iccp_overlay){.memory = env->memory};
    if (status == ICC_OK)
        status = triangulate(&before, n, points, room, env);
    if (status == ICC_OK)
        status = triangulate(&after, n, images, room + 6 * (n - 2), env);
    if (status == ICC_OK)
        status = iccp_overlay_create(overlay, (uint32_t)n, &before, &after, env);
    iccp_free(&env->memory, room);
    return status;
}

icc_status iccp_compatible_create(iccp_plmap *map, const iccp_planar *base,
                                  const icc_domain *source, const double *images, double stretch,
                                  const iccp_env *env)
{
    iccp_overlay overlay;
    icc_status status =
        iccp_compatible_overlay(&overlay, base->n_boundary, base->points, images, env);
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
    return status;
}

icc_status iccp_plmap_of_overlay(iccp_plmap *map, size_t n, const iccp_overlay *overlay,
                                 double stretch, const iccp_memory *memory)
{
    const icc_status status =
        iccp_plmap_begin(map, overlay->n_vertices, overlay->corners.n_triangles, stretch, memory);
    if (status != ICC_OK)
        return status;
    iccp_plmap_fill(map, overlay->points, overlay->images, overlay->corners.vertex,
                    overlay->corners.twin);
    for (uint32_t v = 0; v < overlay->n_vertices; ++v) {
        map->fixed[v] = v < n ? ICCP_ALONG : ICCP_FREE;
        map->facet[v] = v < n ? v : 0;
        map->along[v] = 0;
    }
    return ICC_OK;
}
