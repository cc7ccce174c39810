#include "map/apply.h"

#include "base/threads.h"
#include "chart/bulk.h"
#include "map/curves.h"
#include "map/digits.h"

#include <math.h>

typedef struct map_loop {
    const icc_map *map;
    bool inverse;
    const iccp_memory *memory;
    const double *points;
    double *images;    /* or NULL */
    double *jacobians; /* or NULL */
    icc_status *status;
    atomic_size_t n_failed;
} map_loop;

static icc_status inner_point(const icc_map *map, bool inverse, const double *local, double *image,
                              double *jacobian)
{
    return map->solid != NULL ? iccp_solid_map_point(map->solid, inverse, local, image, jacobian)
                              : iccp_mesh_map_point(map->mesh, inverse, local, image, jacobian);
}

/* Through the mesh; on the boundary straight to the corresponding point of the other cage. */
static icc_status mesh_point(const icc_map *map, bool inverse, const double *point, double *image,
                             double *jacobian)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = inverse ? map->source_domain : map->target_domain;
    const int32_t dim = from->dim;
    double local[3], local_image[3], bary[3];
    uint32_t facet;
    for (int32_t k = 0; k < dim; ++k)
        if (!isfinite(point[k]))
            return ICC_ERR_ARGUMENT;
    iccp_frame_in(&from->frame, dim, point, local);
    const int32_t where = iccp_domain_locate(from, local, true, &facet, bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (where == ICC_BOUNDARY) {
        if (jacobian != NULL)
            return ICC_ERR_TRACE;
        iccp_domain_facet_point(to, facet, bary, local_image);
    } else {
        const icc_status status = inner_point(map, inverse, local, local_image, jacobian);
        if (status != ICC_OK)
            return status;
    }
    iccp_frame_out(&to->frame, dim, local_image, image);
    for (int32_t k = 0; jacobian != NULL && k < dim * dim; ++k)
        jacobian[k] *=
            (from->frame.in[0] * to->frame.out[0]) * (from->frame.in[1] * to->frame.out[1]);
    return ICC_OK;
}

static void fill_nan(double *values, size_t n)
{
    for (size_t k = 0; k < n; ++k)
        values[k] = NAN;
}

/* Whether what does not come back has no image. */
static bool is_guarded(const icc_map *map)
{
    return map->info.kind == ICC_MAP_CURVES && map->info.certified &&
           map->source->info.method == ICC_METHOD_FIELD;
}

static icc_status curves_point(const icc_map *map, bool inverse, const double *point, double *image,
                               double *jacobian, iccp_path *path)
{
    const icc_chart *from = inverse ? map->target : map->source;
    const icc_chart *to = inverse ? map->source : map->target;
    return is_guarded(map) ? iccp_digits_point(from, to, point, image, jacobian, path)
                           : iccp_curves_point(from, to, point, image, jacobian, path);
}

static icc_status map_point(map_loop *loop, size_t i, iccp_path *path)
{
    const icc_map *map = loop->map;
    const size_t dim = (size_t)map->info.dim;
    const double *point = loop->points + dim * i;
    double own[ICC_MAX_DIM];
    double *image = loop->images != NULL ? loop->images + dim * i : own;
    double *jacobian = loop->jacobians != NULL ? loop->jacobians + dim * dim * i : NULL;
    const icc_status status = map->info.kind == ICC_MAP_MESH
                                  ? mesh_point(map, loop->inverse, point, image, jacobian)
                                  : curves_point(map, loop->inverse, point, image, jacobian, path);
    if (status != ICC_OK) {
        fill_nan(image, dim);
        if (jacobian != NULL)
            fill_nan(jacobian, dim * dim);
    }
    return status;
}

static icc_status map_points(map_loop *loop, size_t begin, size_t n, icc_status *status,
                             iccp_path *path)
{
    const icc_map *map = loop->map;
    const size_t dim = (size_t)map->info.dim;
    icc_status all = ICC_OK;
    if (map->info.kind != ICC_MAP_MESH && loop->jacobians == NULL) {
        const icc_chart *from = loop->inverse ? map->target : map->source;
        const icc_chart *to = loop->inverse ? map->source : map->target;
        const double *points = loop->points + dim * begin;
        double *images = loop->images + dim * begin;
        return is_guarded(map)
                   ? iccp_digits_points(from, to, n, points, images, status, path)
                   : iccp_curves_points(from, to, n, points, images, NULL, status, path);
    }
    for (size_t i = 0; i < n && iccp_is_point_status(all); ++i)
        all = status[i] = map_point(loop, begin + i, path);
    return iccp_is_point_status(all) ? ICC_OK : all;
}

static icc_status map_chunk(void *argument, size_t begin, size_t end)
{
    map_loop *loop = argument;
    icc_status status[ICCP_CHART_MANY];
    size_t n_failed = 0;
    iccp_path path;
    iccp_path_init(&path, loop->memory);
    const icc_status all = map_points(loop, begin, end - begin, status, &path);
    iccp_path_clear(&path);
    if (all != ICC_OK)
        return all;
    for (size_t i = begin; i < end; ++i) {
        n_failed += status[i - begin] != ICC_OK;
        if (loop->status != NULL)
            loop->status[i] = status[i - begin];
    }
    atomic_fetch_add(&loop->n_failed, n_failed);
    return ICC_OK;
}

static icc_status run_loop(map_loop *loop, size_t n, size_t *n_failed, const iccp_env *env)
{
    const icc_status status = iccp_for_chunks(env, "trace", n, ICCP_CHART_MANY, map_chunk, loop);
    if (n_failed != NULL)
        *n_failed = atomic_load(&loop->n_failed);
    return status;
}

icc_status iccp_map_apply(const icc_map *map, bool inverse, size_t n, const double *points,
                          double *images, icc_status *status, size_t *n_failed, const iccp_env *env)
{
    map_loop loop = {map, inverse, &env->memory, points, images, NULL, status, 0};
    return run_loop(&loop, n, n_failed, env);
}

icc_status iccp_map_jacobian(const icc_map *map, size_t n, const double *points, double *jacobians,
                             icc_status *status, size_t *n_failed, const iccp_env *env)
{
    map_loop loop = {map, false, &env->memory, points, NULL, jacobians, status, 0};
    return run_loop(&loop, n, n_failed, env);
}
