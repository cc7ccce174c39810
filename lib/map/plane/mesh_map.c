/* The mesh map in the plane as an object, and its points (docs/theory/plane-maps.md). */
#include "map/plane/mesh_map.h"

#include "base/clock.h"
#include "domain/network.h"

#include <string.h>

iccp_mesh_map *iccp_mesh_map_new(const icc_domain *source, const icc_domain *target,
                                 const iccp_memory *memory)
{
    iccp_mesh_map *map = iccp_alloc_zero(memory, 1, sizeof *map);
    if (map != NULL) {
        map->reach[0] = source->band.reach;
        map->reach[1] = target->band.reach;
    }
    return map;
}

icc_status iccp_mesh_map_finish(iccp_mesh_map *map, iccp_map_facts *info, const iccp_env *env)
{
    icc_status status = iccp_progress(env, "check", 0);
    const iccp_planar mesh = {.n_vertices = map->pl.n_vertices,
                              .n_triangles = map->pl.corners.n_triangles,
                              .triangles = map->pl.corners.vertex,
                              .twins = map->pl.corners.twin};
    iccp_finder_init(&map->before, &mesh, map->pl.points, map->reach[0], ICCP_MANY_POINTS,
                     &map->pl.memory);
    iccp_finder_init(&map->after, &mesh, map->pl.images, map->reach[1], ICCP_MANY_POINTS,
                     &map->pl.memory);
    if (status == ICC_OK)
        status = iccp_finder_budget(&map->before, env);
    if (status == ICC_OK)
        status = iccp_finder_budget(&map->after, env);
    info->n_vertices = map->pl.n_vertices;
    info->n_simplices = map->pl.corners.n_triangles;
    return status;
}

void iccp_mesh_map_free(iccp_mesh_map *map, const iccp_memory *memory)
{
    if (map == NULL)
        return;
    iccp_plmap_free(&map->pl);
    iccp_finder_free(&map->before);
    iccp_finder_free(&map->after);
    iccp_newton_plan_release(iccp_once_get(&map->plan));
    iccp_isotopy_free(map->isotopy);
    iccp_free(memory, map);
}

/* ---- points ---- */

static const iccp_finder *finder_of(const iccp_mesh_map *map, bool inverse)
{
    return inverse ? &map->after : &map->before;
}

static const double *images_of(const iccp_mesh_map *map, bool inverse)
{
    return inverse ? map->pl.points : map->pl.images;
}

icc_status iccp_mesh_map_point(const iccp_mesh_map *map, bool inverse, const double *point,
                               double *image, double *jacobian)
{
    iccp_found found;
    const icc_status status = iccp_finder_find(finder_of(map, inverse), point, &found);
    if (status == ICC_OK)
        iccp_mesh_map_image(map, inverse, &found, image, jacobian);
    return status;
}

icc_status iccp_mesh_map_ready(const iccp_mesh_map *map, bool inverse)
{
    return iccp_finder_ready(finder_of(map, inverse));
}

void iccp_mesh_map_find(const iccp_mesh_map *map, bool inverse, size_t n, const double *points,
                        iccp_found *found)
{
    iccp_finder_find_many(finder_of(map, inverse), n, points, images_of(map, inverse), found);
}

/* Whether a vertex is fixed to the network, but not to its rim. */
static bool is_fixed_inside(const iccp_plmap *pl, uint32_t v)
{
    if (pl->fixed[v] != ICCP_ON_NETWORK)
        return false;
    const iccp_network *network = iccp_network_of(pl->featured);
    const uint32_t node = iccp_plmap_node(pl, v);
    bool is = node != UINT32_MAX || !iccp_network_is_rim(network, pl->facet[v]);
    for (uint32_t i = 0; node != UINT32_MAX && i < iccp_network_degree(network, node); ++i)
        is &= !iccp_network_is_rim(network, network->leaving[network->first[node] + i] / 2);
    return is;
}

/* A point is a vertex if the other two weights are 0; its own weight may be rounded. The weights
 * are tested first, because that needs no memory access. */
bool iccp_mesh_map_is_given(const iccp_mesh_map *map, const iccp_found *found, uint32_t *vertex)
{
    const uint32_t *v = map->pl.corners.vertex + 3 * (size_t)found->triangle;
    if ((found->bary[0] > 0) + (found->bary[1] > 0) + (found->bary[2] > 0) > 1)
        return false;
    for (size_t k = 0; k < 3; ++k)
        if (!(found->bary[(k + 1) % 3] > 0) && !(found->bary[(k + 2) % 3] > 0) &&
            is_fixed_inside(&map->pl, v[k])) {
            *vertex = v[k];
            return true;
        }
    return false;
}

void iccp_mesh_map_image(const iccp_mesh_map *map, bool inverse, const iccp_found *found,
                         double *image, double *jacobian)
{
    const double *to = images_of(map, inverse), *bary = found->bary;
    const uint32_t *v = map->pl.corners.vertex + 3 * (size_t)found->triangle;
    for (size_t d = 0; d < 2; ++d)
        image[d] = bary[0] * to[2 * (size_t)v[0] + d] + bary[1] * to[2 * (size_t)v[1] + d] +
                   bary[2] * to[2 * (size_t)v[2] + d];
    uint32_t given;
    if (iccp_mesh_map_is_given(map, found, &given))
        memcpy(image, to + 2 * (size_t)given, 2 * sizeof *to);
    if (jacobian != NULL) {
        const iccp_simplicial_map simplicial = iccp_plmap_simplicial(&map->pl);
        iccp_simplicial_jacobian(&simplicial, inverse, found->triangle, jacobian);
    }
}
