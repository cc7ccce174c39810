#include "map/isotopy/scene.h"

#include <math.h>

icc_status iccp_scene_triangulate(iccp_corners *mesh, const icc_domain *domain, size_t n,
                                  const double *points, const iccp_walls *walls,
                                  const iccp_env *env)
{
    const bool forward = domain->orientation > 0;
    *mesh = (iccp_corners){.vertex = iccp_alloc(&env->memory, n, 6 * sizeof(uint32_t)),
                           .twin = iccp_alloc(&env->memory, n, 6 * sizeof(uint32_t))};
    if (mesh->vertex == NULL || mesh->twin == NULL)
        return ICC_ERR_MEMORY;
    return iccp_triangulate_walls(n, points, walls, forward ? 0 : 1, forward ? 1 : 0, mesh->vertex,
                                  mesh->twin, &mesh->n_triangles, env);
}

/* Points, which may come before lines, have facets too, both ends of which are the same. */
static void list_walls(iccp_scene *scene)
{
    const icc_domain *d = scene->domain[0];
    const iccp_features *f = d->features;
    uint32_t *pair = scene->pairs;
    for (size_t k = 0; k < f->n_places; ++k)
        if (d->facets[2 * k] != d->facets[2 * k + 1]) {
            *pair++ = d->facets[2 * k];
            *pair++ = d->facets[2 * k + 1];
        }
    for (size_t v = 0; v < f->n_outer; ++v)
        scene->component[v] = 0;
    for (size_t k = 0; k < f->n; ++k)
        for (size_t v = f->item[k].first; v < f->item[k].first + f->item[k].n; ++v)
            scene->component[v] = 1 + (uint32_t)k;
}

icc_status iccp_scene_create(iccp_scene *scene, const icc_domain *source, const icc_domain *target,
                             const iccp_env *env)
{
    const iccp_features *features = source->features;
    *scene = (iccp_scene){.memory = env->memory,
                          .domain = {source, target},
                          .n = source->n_vertices,
                          .n_components = 1 + features->n,
                          .n_walls = features->n_places - features->n_points,
                          .scale = sqrt(source->measure / target->measure)};
    scene->component = iccp_alloc(&env->memory, scene->n, sizeof *scene->component);
    scene->pairs = iccp_alloc(&env->memory, scene->n_walls, 2 * sizeof *scene->pairs);
    icc_status status = ICC_ERR_MEMORY;
    if (scene->component != NULL && scene->pairs != NULL) {
        list_walls(scene);
        status =
            iccp_walls_create(&scene->walls, scene->n, scene->n_walls, scene->pairs, &env->memory);
    }
    for (int k = 0; status == ICC_OK && k < 2; ++k)
        status = iccp_scene_triangulate(&scene->mesh[k], scene->domain[k], scene->n,
                                        scene->domain[k]->vertices, &scene->walls, env);
    if (status != ICC_OK)
        iccp_scene_free(scene);
    return status;
}

void iccp_scene_free(iccp_scene *scene)
{
    const iccp_memory *memory = &scene->memory;
    iccp_free(memory, scene->component);
    iccp_free(memory, scene->pairs);
    iccp_walls_free(&scene->walls, memory);
    for (int k = 0; k < 2; ++k) {
        iccp_free(memory, scene->mesh[k].vertex);
        iccp_free(memory, scene->mesh[k].twin);
    }
    *scene = (iccp_scene){.memory = *memory};
}
