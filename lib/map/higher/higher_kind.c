#include "map/higher/higher_kind.h"

#include "base/error.h"
#include "map/higher/higher_map.h"
#include "map/kind/caller_point.h"

#include <string.h>

static bool suits(const icc_domain *source)
{
    return source->dim > 3;
}

/* These maps are made without charts. */
static bool takes(const icc_chart *source)
{
    (void)source;
    return false;
}

static icc_status create(icc_map *map, const icc_map_options *options, const iccp_env *env,
                         icc_error *err)
{
    iccp_higher_map *higher;
    (void)err;
    const icc_status status = iccp_higher_map_create(
        &higher, map->source_domain, map->target_domain, options->iterations, &map->info, env);
    map->state = higher;
    return status;
}

/* The proof is that of solids (solid_certificate.c). Beyond 3-D libicc does not check whether a
 * boundary meets itself, so the caller must know that it does not. */
static icc_status certify(icc_map *map, const iccp_env *env, icc_error *err)
{
    const iccp_higher_map *higher = map->state;
    const iccp_simplices *mesh = higher->mesh;
    const iccp_env quiet = iccp_quiet(env);
    const iccp_simplicial_map after = iccp_higher_simplicial(higher);
    const iccp_simplicial_map before = iccp_simplicial_map_of(mesh, mesh->points);
    const size_t n_faults = iccp_simplicial_count_at_once(&before, &quiet) +
                            iccp_simplicial_count_at_once(&after, &quiet);
    const bool is_bounded = memcmp(higher->images, map->target_domain->vertices,
                                   mesh->dim * mesh->n_boundary * sizeof *higher->images) == 0;
    map->info.certified = n_faults == 0 && is_bounded;
    if (map->info.certified)
        return ICC_OK;
    return iccp_fail(err, ICC_ERR_CERTIFICATE, "the mesh map cannot be certified: %zu faults%s",
                     n_faults, is_bounded ? "" : ", and its boundary is not the target's");
}

static icc_status ready(const icc_map *map, bool inverse)
{
    (void)map;
    (void)inverse;
    return ICC_OK;
}

/* Through the simplices; on the boundary straight to the corresponding point of the other one. */
static icc_status map_point(const icc_map *map, bool inverse, const double *point, double *image,
                            double *jacobian)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = inverse ? map->source_domain : map->target_domain;
    double local[ICC_MAX_DIM], local_image[ICC_MAX_DIM], bary[ICC_MAX_DIM];
    uint32_t facet;
    if (!iccp_point_is_finite((size_t)from->dim, point))
        return ICC_ERR_ARGUMENT;
    iccp_frame_in(&from->frame, from->dim, point, local);
    const int32_t where = iccp_domain_locate(from, local, true, &facet, bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    const icc_status status =
        where == ICC_BOUNDARY
            ? iccp_image_on_boundary(to, facet, bary, local_image, jacobian)
            : iccp_higher_map_point(map->state, inverse, local, local_image, jacobian);
    if (status == ICC_OK)
        iccp_image_out(from, to, from->dim, local_image, image, jacobian);
    return status;
}

static icc_status apply(const icc_map *map, bool inverse, size_t n, const double *points,
                        double *images, double *jacobians, icc_status *status, iccp_path *path)
{
    const size_t dim = (size_t)map->info.dim;
    double own[ICC_MAX_DIM];
    (void)path;
    for (size_t i = 0; i < n; ++i) {
        double *image = images != NULL ? images + dim * i : own;
        double *jacobian = jacobians != NULL ? jacobians + dim * dim * i : NULL;
        status[i] = map_point(map, inverse, points + dim * i, image, jacobian);
        if (status[i] != ICC_OK)
            iccp_image_none(dim, image, jacobian);
    }
    return ICC_OK;
}

static iccp_simplicial_map mesh(const icc_map *map)
{
    return iccp_higher_simplicial(map->state);
}

static icc_status renew(icc_map *map, bool *kept, const iccp_env *env)
{
    *kept = true;
    return iccp_higher_map_replant(map->state, env);
}

static icc_status improve(icc_map *next, const icc_map *map, const icc_improve_options *options,
                          icc_improve_report *report, const iccp_env *env, icc_error *err)
{
    iccp_higher_map *better;
    (void)err;
    const icc_status status = iccp_higher_map_improve(&better, map->state, map->source_domain,
                                                      map->target_domain, options, report, env);
    next->state = better;
    return status;
}

static icc_status retarget(icc_map *next, const icc_map *map, int32_t iterations, size_t *vertex,
                           const iccp_env *env, icc_error *err)
{
    iccp_higher_map *higher;
    (void)vertex;
    (void)err;
    const icc_status status =
        iccp_higher_map_follow(&higher, map->state, map->source_domain, map->target_domain,
                               next->target_domain, iterations, &next->info, env);
    next->state = higher;
    return status;
}

static icc_status visit(iccp_blob *b, icc_map *map, const iccp_env *env)
{
    iccp_higher_map *higher = map->state;
    const icc_status status =
        iccp_higher_map_visit(b, &higher, map->source_domain, map->target_domain, &map->info, env);
    map->state = higher;
    return status;
}

static void free_state(icc_map *map)
{
    iccp_higher_map_free(map->state);
}

const iccp_map_kind iccp_higher_kind = {.number = ICC_MAP_MESH,
                                        .suits = suits,
                                        .takes = takes,
                                        .create = create,
                                        .certify = certify,
                                        .ready = ready,
                                        .apply = apply,
                                        .mesh = mesh,
                                        .renew = renew,
                                        .improve = improve,
                                        .retarget = retarget,
                                        .visit = visit,
                                        .free_state = free_state};
