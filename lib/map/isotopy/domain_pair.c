/* Makes the bare triangulations of two domains whose features correspond. */
#include "map/isotopy/domain_pair.h"

#include <math.h>

icc_status iccp_triangulate_inside(iccp_corners *mesh, const icc_domain *domain, size_t n,
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

/* Skips the facets of points, whose two ends are the same vertex. Points may come before lines. */
static void list_walls(iccp_domain_pair *domains)
{
    const icc_domain *d = domains->domain[0];
    const iccp_features *f = d->features;
    uint32_t *pair = domains->pairs;
    for (size_t k = 0; k < f->n_places; ++k)
        if (d->facets[2 * k] != d->facets[2 * k + 1]) {
            *pair++ = d->facets[2 * k];
            *pair++ = d->facets[2 * k + 1];
        }
    for (size_t v = 0; v < f->n_outer; ++v)
        domains->component[v] = 0;
    for (size_t k = 0; k < f->n; ++k)
        for (size_t v = f->item[k].first; v < f->item[k].first + f->item[k].n; ++v)
            domains->component[v] = 1 + (uint32_t)k;
}

icc_status iccp_domain_pair_create(iccp_domain_pair *domains, const icc_domain *source,
                                   const icc_domain *target, const iccp_env *env)
{
    const iccp_features *features = source->features;
    *domains = (iccp_domain_pair){.memory = env->memory,
                                  .domain = {source, target},
                                  .n = source->n_vertices,
                                  .n_components = 1 + features->n,
                                  .n_walls = features->n_places - features->n_points,
                                  .scale = sqrt(source->measure / target->measure)};
    domains->component = iccp_alloc(&env->memory, domains->n, sizeof *domains->component);
    domains->pairs = iccp_alloc(&env->memory, domains->n_walls, 2 * sizeof *domains->pairs);
    icc_status status = ICC_ERR_MEMORY;
    if (domains->component != NULL && domains->pairs != NULL) {
        list_walls(domains);
        status = iccp_walls_create(&domains->walls, domains->n, domains->n_walls, domains->pairs,
                                   &env->memory);
    }
    for (int k = 0; status == ICC_OK && k < 2; ++k)
        status = iccp_triangulate_inside(&domains->mesh[k], domains->domain[k], domains->n,
                                         domains->domain[k]->vertices, &domains->walls, env);
    if (status != ICC_OK)
        iccp_domain_pair_free(domains);
    return status;
}

void iccp_domain_pair_free(iccp_domain_pair *domains)
{
    const iccp_memory *memory = &domains->memory;
    iccp_free(memory, domains->component);
    iccp_free(memory, domains->pairs);
    iccp_walls_free(&domains->walls, memory);
    for (int k = 0; k < 2; ++k) {
        iccp_free(memory, domains->mesh[k].vertex);
        iccp_free(memory, domains->mesh[k].twin);
    }
    *domains = (iccp_domain_pair){.memory = *memory};
}
