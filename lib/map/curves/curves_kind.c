/* The table of operations of curve maps. See map/kind/kind.h. */
#include "map/curves/curves_kind.h"

#include "chart/encode_points.h"
#include "map/curves/curves.h"
#include "map/curves/curves_certificate.h"
#include "map/curves/round_trip.h"
#include "map/kind/caller_point.h"

static bool suits(const icc_domain *source)
{
    (void)source;
    return true;
}

static bool takes(const icc_chart *source)
{
    (void)source;
    return true;
}

/* A curve map consists of its charts, so there is nothing to create. */
static icc_status create(icc_map *map, const icc_map_options *options, const iccp_env *env,
                         icc_error *err)
{
    (void)map;
    (void)options;
    (void)env;
    (void)err;
    return ICC_OK;
}

/* Returns true if the charts alone do not guarantee that images come back. Points whose images
 * do not come back then have no image. */
static bool is_guarded(const icc_map *map)
{
    return map->info.certified && map->source->info.method == ICC_METHOD_FIELD;
}

static icc_status ready(const icc_map *map, bool inverse)
{
    const icc_status status = iccp_chart_ready(inverse ? map->target : map->source, false);
    return status == ICC_OK ? iccp_chart_ready(inverse ? map->source : map->target, true) : status;
}

/* Computes images and Jacobians point by point. */
static icc_status differentiate(const icc_map *map, bool inverse, size_t n, const double *points,
                                double *images, double *jacobians, icc_status *status,
                                iccp_path *path)
{
    const icc_chart *from = inverse ? map->target : map->source;
    const icc_chart *to = inverse ? map->source : map->target;
    const size_t dim = (size_t)map->info.dim;
    double own[ICC_MAX_DIM];
    icc_status all = ICC_OK;
    for (size_t i = 0; i < n && iccp_is_point_status(all); ++i) {
        const double *point = points + dim * i;
        double *image = images != NULL ? images + dim * i : own;
        double *jacobian = jacobians + dim * dim * i;
        all = status[i] = is_guarded(map)
                              ? iccp_checked_point(from, to, point, image, jacobian, path)
                              : iccp_curves_point(from, to, point, image, jacobian, path);
        if (all != ICC_OK)
            iccp_image_none(dim, image, jacobian);
    }
    return iccp_is_point_status(all) ? ICC_OK : all;
}

static icc_status apply(const icc_map *map, bool inverse, size_t n, const double *points,
                        double *images, double *jacobians, icc_status *status, iccp_path *path)
{
    const icc_chart *from = inverse ? map->target : map->source;
    const icc_chart *to = inverse ? map->source : map->target;
    if (jacobians != NULL)
        return differentiate(map, inverse, n, points, images, jacobians, status, path);
    return is_guarded(map) ? iccp_checked_points(from, to, n, points, images, status, path)
                           : iccp_curves_points(from, to, n, points, images, NULL, status, path);
}

static void free_state(icc_map *map)
{
    (void)map;
}

const iccp_map_kind iccp_curves_kind = {.number = ICC_MAP_CURVES,
                                        .suits = suits,
                                        .takes = takes,
                                        .create = create,
                                        .certify = iccp_curves_certify,
                                        .ready = ready,
                                        .apply = apply,
                                        .free_state = free_state};
