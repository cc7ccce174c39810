/* Makes the bare triangulations of two domains whose features correspond. */
#include "map/isotopy/domain_pair.h"

#include "base/sets.h"

#include <math.h>
#include <string.h>

/* ---- triangulating the inside ---- */

/* The points that are triangulated: nodes, and what follows the vertices. */
typedef struct selection {
    uint32_t *number, *point; /* of each point: its number among them; and back */
    uint32_t *pairs;          /* the walls, by these numbers */
    double *points;
    size_t n;
    iccp_walls walls, rim;
} selection;

static void free_selection(selection *s, const iccp_memory *memory)
{
    iccp_free(memory, s->number);
    iccp_free(memory, s->point);
    iccp_free(memory, s->pairs);
    iccp_free(memory, s->points);
    iccp_walls_free(&s->walls, memory);
    iccp_walls_free(&s->rim, memory);
}

static icc_status choose(selection *s, const iccp_domain_pair *domains, size_t n,
                         const double *points, size_t n_walls, const uint32_t *pairs,
                         const iccp_memory *memory)
{
    *s = (selection){.number = iccp_alloc(memory, n, sizeof *s->number),
                     .point = iccp_alloc(memory, n, sizeof *s->point),
                     .pairs = iccp_alloc(memory, n_walls, 2 * sizeof *s->pairs),
                     .points = iccp_alloc(memory, n, 2 * sizeof *s->points)};
    if (s->number == NULL || s->point == NULL || s->pairs == NULL || s->points == NULL)
        return ICC_ERR_MEMORY;
    for (uint32_t v = 0; v < n; ++v) {
        if (v < domains->n && domains->node[v] != v)
            continue;
        memcpy(s->points + 2 * s->n, points + 2 * (size_t)v, 2 * sizeof *points);
        s->point[s->n] = v;
        s->number[v] = (uint32_t)s->n++;
    }
    for (size_t k = 0; k < 2 * n_walls; ++k)
        s->pairs[k] = s->number[pairs[k]];
    const icc_status status = iccp_walls_create(&s->walls, s->n, n_walls, s->pairs, memory);
    return status == ICC_OK ? iccp_walls_create(&s->rim, s->n, domains->n_rim, s->pairs, memory)
                            : status;
}

icc_status iccp_triangulate_inside(iccp_corners *mesh, const iccp_domain_pair *domains, size_t n,
                                   const double *points, size_t n_walls, const uint32_t *pairs,
                                   const iccp_env *env)
{
    const iccp_memory *memory = &env->memory;
    selection s;
    icc_status status = choose(&s, domains, n, points, n_walls, pairs, memory);
    *mesh = (iccp_corners){.vertex = iccp_alloc(memory, s.n, 6 * sizeof(uint32_t)),
                           .twin = iccp_alloc(memory, s.n, 6 * sizeof(uint32_t))};
    if (mesh->vertex == NULL || mesh->twin == NULL)
        status = ICC_ERR_MEMORY;
    if (status == ICC_OK)
        status = iccp_triangulate_walls(s.n, s.points, &s.walls, &s.rim, mesh->vertex, mesh->twin,
                                        &mesh->n_triangles, env);
    for (size_t c = 0; status == ICC_OK && c < 3 * mesh->n_triangles; ++c)
        mesh->vertex[c] = s.point[mesh->vertex[c]];
    free_selection(&s, memory);
    return status;
}

/* ---- pairs of domains ---- */

/* Lists the sides of the rim, then the others. */
static void list_walls(iccp_domain_pair *domains)
{
    const icc_domain *d = domains->domain[0];
    const iccp_network *network = domains->network;
    uint32_t *pair = domains->pairs;
    for (int is_rim = 1; is_rim >= 0; --is_rim)
        for (uint32_t f = 0; f < d->features->n_places; ++f)
            if (network->side[f] == f && d->facets[2 * (size_t)f] != d->facets[2 * (size_t)f + 1] &&
                iccp_network_is_rim(network, f) == (is_rim == 1)) {
                *pair++ = iccp_network_origin(network, d, 2 * f);
                *pair++ = iccp_network_origin(network, d, 2 * f + 1);
            }
}

/* Joins the components that an edge of the bare triangulation joins. */
static void find_parts(iccp_domain_pair *domains)
{
    const iccp_corners *mesh = &domains->mesh[0];
    iccp_sets_begin(domains->part, domains->n_components);
    for (uint32_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        const uint32_t a = domains->component[mesh->vertex[c]];
        const uint32_t b = domains->component[mesh->vertex[iccp_after(c)]];
        domains->n_cuts += iccp_sets_join(domains->part, a, b);
    }
    for (uint32_t k = 0; k < domains->n_components; ++k)
        domains->part[k] = iccp_sets_leader(domains->part, k);
}

icc_status iccp_domain_pair_create(iccp_domain_pair *domains, const icc_domain *source,
                                   const icc_domain *target, const iccp_env *env)
{
    const iccp_network *network = iccp_network_of(source);
    *domains = (iccp_domain_pair){.memory = env->memory,
                                  .domain = {source, target},
                                  .n = source->n_vertices,
                                  .n_components = network->n_pieces,
                                  .n_walls = network->n_sides,
                                  .n_rim = network->n_rim,
                                  .network = network,
                                  .node = network->node,
                                  .component = network->piece,
                                  .scale = sqrt(source->measure / target->measure)};
    domains->part = iccp_alloc(&env->memory, domains->n_components, sizeof *domains->part);
    domains->pairs = iccp_alloc(&env->memory, domains->n_walls, 2 * sizeof *domains->pairs);
    icc_status status = ICC_ERR_MEMORY;
    if (domains->part != NULL && domains->pairs != NULL) {
        list_walls(domains);
        status = iccp_walls_create(&domains->walls, domains->n, domains->n_walls, domains->pairs,
                                   &env->memory);
    }
    for (int k = 0; status == ICC_OK && k < 2; ++k)
        status = iccp_triangulate_inside(&domains->mesh[k], domains, domains->n,
                                         domains->domain[k]->vertices, domains->n_walls,
                                         domains->pairs, env);
    if (status == ICC_OK)
        find_parts(domains);
    else
        iccp_domain_pair_free(domains);
    return status;
}

void iccp_domain_pair_free(iccp_domain_pair *domains)
{
    const iccp_memory *memory = &domains->memory;
    iccp_free(memory, domains->part);
    iccp_free(memory, domains->pairs);
    iccp_walls_free(&domains->walls, memory);
    for (int k = 0; k < 2; ++k) {
        iccp_free(memory, domains->mesh[k].vertex);
        iccp_free(memory, domains->mesh[k].twin);
    }
    *domains = (iccp_domain_pair){.memory = *memory};
}
