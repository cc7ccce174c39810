#include "map/solid/solid_kind.h"

#include "map/kind/caller_point.h"
#include "map/solid/solid_certificate.h"
#include "map/solid/solid_follow.h"

static iccp_solid_map *state_of(const icc_map *map)
{
    return map->state;
}

static bool suits(const icc_domain *source)
{
    return source->dim == 3;
}

/* Foliations on meshes in space. */
static bool takes(const icc_chart *source)
{
    return source->info.method == ICC_METHOD_FOLIATION && source->domain->dim == 3;
}

static icc_status create(icc_map *map, const icc_map_options *options, const iccp_env *env,
                         icc_error *err)
{
    iccp_solid_map *solid;
    (void)err;
    const icc_status status = iccp_solid_map_create(&solid, map->source_domain, map->target_domain,
                                                    options->iterations, &map->info, env);
    map->state = solid;
    return status;
}

static icc_status ready(const icc_map *map, bool inverse)
{
    (void)map;
    (void)inverse;
    return ICC_OK;
}

/* Through the tetrahedra; on the boundary straight to the corresponding point of the other
 * cage. */
static icc_status map_point(const icc_map *map, bool inverse, const double *point, double *image,
                            double *jacobian)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = inverse ? map->source_domain : map->target_domain;
    double local[3], local_image[3], bary[3];
    uint32_t facet;
    if (!iccp_point_is_finite(3, point))
        return ICC_ERR_ARGUMENT;
    iccp_frame_in(&from->frame, 3, point, local);
    const int32_t where = iccp_domain_locate(from, local, true, &facet, bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    const icc_status status =
        where == ICC_BOUNDARY
            ? iccp_image_on_boundary(to, facet, bary, local_image, jacobian)
            : iccp_solid_map_point(map->state, inverse, local, local_image, jacobian);
    if (status == ICC_OK)
        iccp_image_out(from, to, 3, local_image, image, jacobian);
    return status;
}

static icc_status apply(const icc_map *map, bool inverse, size_t n, const double *points,
                        double *images, double *jacobians, icc_status *status, iccp_path *path)
{
    double own[3];
    (void)path;
    for (size_t i = 0; i < n; ++i) {
        double *image = images != NULL ? images + 3 * i : own;
        double *jacobian = jacobians != NULL ? jacobians + 9 * i : NULL;
        status[i] = map_point(map, inverse, points + 3 * i, image, jacobian);
        if (status[i] != ICC_OK)
            iccp_image_none(3, image, jacobian);
    }
    return ICC_OK;
}

static iccp_simplicial_map mesh(const icc_map *map)
{
    return iccp_solid_simplicial(map->state);
}

static icc_status regions(const icc_map *map, uint32_t *regions)
{
    const iccp_simplices *own = state_of(map)->mesh;
    for (size_t s = 0; s < own->n_simplices; ++s)
        regions[s] = own->region != NULL ? own->region[s] : 0;
    return ICC_OK;
}

static icc_status renew(icc_map *map, bool *kept, const iccp_env *env)
{
    iccp_solid_map *solid = state_of(map);
    iccp_solid_place_fixed(solid->mesh, map->target_domain, solid->images);
    *kept = true;
    return iccp_solid_map_replant(solid, env);
}

static icc_status improve(icc_map *next, const icc_map *map, const icc_improve_options *options,
                          icc_improve_report *report, const iccp_env *env, icc_error *err)
{
    iccp_solid_map *better;
    (void)err;
    const icc_status status = iccp_solid_map_improve(&better, state_of(map), map->source_domain,
                                                     map->target_domain, options, report, env);
    next->state = better;
    return status;
}

static icc_status retarget(icc_map *next, const icc_map *map, int32_t iterations, size_t *vertex,
                           const iccp_env *env, icc_error *err)
{
    iccp_solid_map *solid;
    (void)err;
    const icc_status status =
        iccp_solid_map_follow(&solid, state_of(map), map->source_domain, map->target_domain,
                              next->target_domain, iterations, &next->info, vertex, env);
    next->state = solid;
    return status;
}

static icc_status visit(iccp_blob *b, icc_map *map, const iccp_env *env)
{
    iccp_solid_map *solid = map->state;
    const icc_status status =
        iccp_solid_map_visit(b, &solid, map->source_domain, map->target_domain, &map->info, env);
    map->state = solid;
    return status;
}

static void free_state(icc_map *map)
{
    iccp_solid_map_free(map->state);
}

const iccp_map_kind iccp_solid_kind = {.number = ICC_MAP_MESH,
                                       .suits = suits,
                                       .takes = takes,
                                       .create = create,
                                       .certify = iccp_solid_certify,
                                       .ready = ready,
                                       .apply = apply,
                                       .mesh = mesh,
                                       .regions = regions,
                                       .renew = renew,
                                       .improve = improve,
                                       .retarget = retarget,
                                       .visit = visit,
                                       .free_state = free_state};
