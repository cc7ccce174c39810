/* The operations of mesh maps in the plane, gathered in one table. */
#include "map/plane/plane_kind.h"

#include "domain/features.h"
#include "map/compatible/plmap_file.h"
#include "map/plane/plane_apply.h"
#include "map/plane/plane_certificate.h"
#include "map/plane/plane_improve.h"
#include "map/plane/plane_regions.h"
#include "map/plane/plane_retarget.h"
#include "map/plane/plane_start.h"

static bool suits(const icc_domain *source)
{
    return source->dim == 2;
}

static bool takes(const icc_chart *source)
{
    return source->mesh != NULL;
}

/* Finds the isotopy of a map with features, and fills in the members of its info about ties,
 * except for class_kept. */
static icc_status describe(icc_map *map, const iccp_env *env)
{
    const iccp_features *features = map->source_domain->features;
    iccp_mesh_map *plane = map->state;
    iccp_map_facts *info = &map->info;
    if (features == NULL)
        return ICC_OK;
    const icc_status status = iccp_isotopy_create(&plane->isotopy, &plane->pl, map->source_domain,
                                                  map->target_domain, env);
    info->n_ties = plane->isotopy != NULL ? plane->isotopy->n : 0;
    info->detour = plane->isotopy != NULL ? plane->isotopy->detour : 0;
    return status;
}

static icc_status create(icc_map *map, const icc_map_options *options, const iccp_env *env,
                         icc_error *err)
{
    iccp_mesh_map *plane;
    const icc_status status =
        map->source == NULL
            ? iccp_mesh_map_create_features(&plane, map->source_domain, map->target_domain, options,
                                            &map->info, env, err)
            : iccp_mesh_map_create(&plane, map->source, map->target, options->iterations,
                                   &map->info, env, err);
    map->state = plane;
    return status;
}

static icc_status ready(const icc_map *map, bool inverse)
{
    return iccp_mesh_map_ready(map->state, inverse);
}

static iccp_simplicial_map mesh(const icc_map *map)
{
    const iccp_mesh_map *plane = map->state;
    return iccp_plmap_simplicial(&plane->pl);
}

static icc_status regions(const icc_map *map, uint32_t *regions)
{
    const iccp_mesh_map *plane = map->state;
    return iccp_plmap_find_regions(regions, &plane->pl, &map->memory);
}

/* Makes the isotopy again. Nothing else depends on the images, because the finders of points are
 * made when they are first needed. */
static icc_status renew(icc_map *map, bool *kept, const iccp_env *env)
{
    iccp_mesh_map *plane = map->state;
    iccp_isotopy *const own = plane->isotopy;
    const iccp_map_facts info = map->info;
    plane->isotopy = NULL;
    const icc_status status = describe(map, env);
    *kept = status != ICC_OK || map->source_domain->features == NULL ||
            iccp_isotopy_same(own, plane->isotopy);
    if (*kept) {
        iccp_isotopy_free(own);
    } else {
        iccp_isotopy_free(plane->isotopy);
        plane->isotopy = own;
        map->info = info;
    }
    return status;
}

static icc_status improve(icc_map *next, const icc_map *map, const icc_improve_options *options,
                          icc_improve_report *report, const iccp_env *env, icc_error *err)
{
    iccp_mesh_map *better;
    (void)err;
    const icc_status status = iccp_mesh_map_improve(
        &better, map->state, map->source_domain->n_facets, options, report, env);
    next->state = better;
    return status;
}

static icc_status retarget(icc_map *next, const icc_map *map, int32_t iterations, size_t *vertex,
                           const iccp_env *env, icc_error *err)
{
    iccp_mesh_map *moved;
    (void)vertex;
    const icc_status status =
        iccp_mesh_map_retarget(&moved, map->state, map->source_domain, map->target_domain,
                               next->target_domain, iterations, &next->info, env, err);
    next->state = moved;
    return status;
}

static icc_status keeps_class(bool *kept, const icc_map *next, const icc_map *map, bool moved,
                              const iccp_env *env)
{
    const iccp_mesh_map *before = map->state, *after = next->state;
    if (moved)
        return iccp_isotopy_is_kept(kept, before->isotopy, map->target_domain, &after->pl,
                                    map->source_domain, next->target_domain, env);
    *kept = iccp_isotopy_same(before->isotopy, after->isotopy);
    return ICC_OK;
}

static icc_status tie(const icc_map *map, size_t tie, icc_tie_info *info, double *target)
{
    const iccp_isotopy *isotopy = iccp_plane_of(map)->isotopy;
    if (isotopy == NULL || tie >= isotopy->n)
        return ICC_ERR_ARGUMENT;
    *info = iccp_isotopy_tie(isotopy, tie, map->source_domain, map->target_domain, target);
    return ICC_OK;
}

static icc_status visit(iccp_blob *b, icc_map *map, const iccp_env *env)
{
    if (b->reads)
        map->state = iccp_mesh_map_new(map->source_domain, map->target_domain, &env->memory);
    iccp_mesh_map *plane = map->state;
    if (plane == NULL)
        return ICC_ERR_MEMORY;
    const icc_status status =
        iccp_plmap_visit(b, &plane->pl, map->source_domain, map->target_domain, env);
    return status == ICC_OK && b->reads ? iccp_mesh_map_finish(plane, &map->info, env) : status;
}

static void free_state(icc_map *map)
{
    iccp_mesh_map_free(map->state, &map->memory);
}

const iccp_map_kind iccp_plane_kind = {.number = ICC_MAP_MESH,
                                       .suits = suits,
                                       .takes = takes,
                                       .create = create,
                                       .certify = iccp_plane_certify,
                                       .describe = describe,
                                       .ready = ready,
                                       .apply = iccp_plane_apply,
                                       .mesh = mesh,
                                       .regions = regions,
                                       .renew = renew,
                                       .improve = improve,
                                       .retarget = retarget,
                                       .keeps_class = keeps_class,
                                       .tie = tie,
                                       .visit = visit,
                                       .free_state = free_state};
