#include "map/apply.h"

#include "base/compiler.h"
#include "base/threads.h"
#include "chart/bulk.h"
#include "chart/curves.h"
#include "chart/digits.h"

#include <assert.h>
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

/* The point of the other cage where a boundary point goes, which has no Jacobian. */
static icc_status boundary_point(const icc_domain *to, uint32_t facet, const double *bary,
                                 double *image, const double *jacobian)
{
    if (jacobian != NULL)
        return ICC_ERR_TRACE;
    iccp_domain_facet_point(to, facet, bary, image);
    return ICC_OK;
}

/* A local image, in the caller's coordinates. */
static ICCP_INLINE void bring_out(const icc_domain *from, const icc_domain *to, int32_t dim,
                                  const double *local, double *image, double *jacobian)
{
    iccp_frame_out(&to->frame, dim, local, image);
    for (int32_t k = 0; jacobian != NULL && k < dim * dim; ++k)
        jacobian[k] *=
            (from->frame.in[0] * to->frame.out[0]) * (from->frame.in[1] * to->frame.out[1]);
}

static bool is_finite(int32_t dim, const double *point)
{
    bool finite = true;
    for (int32_t k = 0; k < dim; ++k)
        finite &= isfinite(point[k]);
    return finite;
}

/* Through the tetrahedra; on the boundary straight to the corresponding point of the other
 * cage. */
static icc_status solid_point(const icc_map *map, bool inverse, const double *point, double *image,
                              double *jacobian)
{
    const icc_domain *from = inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = inverse ? map->source_domain : map->target_domain;
    double local[3], local_image[3], bary[3];
    uint32_t facet;
    if (!is_finite(3, point))
        return ICC_ERR_ARGUMENT;
    iccp_frame_in(&from->frame, 3, point, local);
    const int32_t where = iccp_domain_locate(from, local, true, &facet, bary);
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    const icc_status status =
        where == ICC_BOUNDARY
            ? boundary_point(to, facet, bary, local_image, jacobian)
            : iccp_solid_map_point(map->solid, inverse, local, local_image, jacobian);
    if (status == ICC_OK)
        bring_out(from, to, 3, local_image, image, jacobian);
    return status;
}

static ICCP_INLINE void give_none(size_t dim, double *image, double *jacobian)
{
    for (size_t k = 0; k < dim; ++k)
        image[k] = NAN;
    for (size_t k = 0; jacobian != NULL && k < dim * dim; ++k)
        jacobian[k] = NAN;
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
    const icc_status status = map->solid != NULL
                                  ? solid_point(map, loop->inverse, point, image, jacobian)
                                  : curves_point(map, loop->inverse, point, image, jacobian, path);
    if (status != ICC_OK)
        give_none(dim, image, jacobian);
    return status;
}

/* ---- the mesh in the plane ---- */

/* Given vertices go to theirs, be they as near as that. */
static bool is_given(const icc_map *map, const iccp_found *found)
{
    uint32_t vertex;
    return found->triangle != ICCP_NO_NEIGHBOUR &&
           iccp_mesh_map_is_given(map->mesh, found, &vertex);
}

/* Where a triangle holds a point and the boundary is not near, the point is inside, and where none
 * does it is outside, as the domain would say: it counts as on the boundary only within the reach
 * of the band, and the mesh's own boundary follows the domain's to within 1.5 times that, so that
 * neither lies between the other and a point farther than 4 times the reach from the mesh's. Near
 * it, the domain is asked. */
static icc_status plane_point(const map_loop *loop, const double *point, const double *local,
                              const iccp_found *found, double *image, double *jacobian)
{
    const icc_map *map = loop->map;
    const icc_domain *from = loop->inverse ? map->target_domain : map->source_domain;
    const icc_domain *to = loop->inverse ? map->source_domain : map->target_domain;
    double local_image[2], bary[2];
    uint32_t facet;
    icc_status status = ICC_OK;
    int32_t where = found->triangle != ICCP_NO_NEIGHBOUR ? ICC_INSIDE : ICC_OUTSIDE;
    if (found->is_near && !is_given(map, found)) {
        if (!is_finite(2, point))
            return ICC_ERR_ARGUMENT;
        where = iccp_domain_locate(from, local, true, &facet, bary);
    }
    if (where == ICC_OUTSIDE)
        return ICC_ERR_OUTSIDE;
    if (where == ICC_BOUNDARY)
        status = boundary_point(to, facet, bary, local_image, jacobian);
    else if (found->triangle != ICCP_NO_NEIGHBOUR)
        iccp_mesh_map_image(map->mesh, loop->inverse, found, local_image, jacobian);
    else
        status = ICC_ERR_TRACE;
    if (status == ICC_OK)
        bring_out(from, to, 2, local_image, image, jacobian);
    return status;
}

static_assert((int)ICCP_FINDER_MANY >= (int)ICCP_CHART_MANY, "all points of a chunk at once");

static void plane_points(const map_loop *loop, size_t begin, size_t n, icc_status *status)
{
    const icc_map *map = loop->map;
    const icc_domain *from = loop->inverse ? map->target_domain : map->source_domain;
    const double *points = loop->points + 2 * begin;
    double local[2 * ICCP_CHART_MANY], own[2];
    iccp_found found[ICCP_CHART_MANY];
    for (size_t i = 0; i < n; ++i)
        iccp_frame_in(&from->frame, 2, points + 2 * i, local + 2 * i);
    iccp_mesh_map_find(map->mesh, loop->inverse, n, local, found);
    for (size_t i = 0; i < n; ++i) {
        double *image = loop->images != NULL ? loop->images + 2 * (begin + i) : own;
        double *jacobian = loop->jacobians != NULL ? loop->jacobians + 4 * (begin + i) : NULL;
        status[i] = plane_point(loop, points + 2 * i, local + 2 * i, &found[i], image, jacobian);
        if (status[i] != ICC_OK)
            give_none(2, image, jacobian);
    }
}

static icc_status map_points(map_loop *loop, size_t begin, size_t n, icc_status *status,
                             iccp_path *path)
{
    const icc_map *map = loop->map;
    const size_t dim = (size_t)map->info.dim;
    icc_status all = ICC_OK;
    if (map->mesh != NULL) {
        plane_points(loop, begin, n, status);
        return ICC_OK;
    }
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

/* What is made when it is first needed. */
static icc_status make_ready(const map_loop *loop)
{
    const icc_map *map = loop->map;
    if (map->solid != NULL)
        return ICC_OK;
    if (map->mesh != NULL)
        return iccp_mesh_map_ready(map->mesh, loop->inverse);
    const icc_status status = iccp_chart_ready(loop->inverse ? map->target : map->source, false);
    return status == ICC_OK ? iccp_chart_ready(loop->inverse ? map->source : map->target, true)
                            : status;
}

static icc_status run_loop(map_loop *loop, size_t n, size_t *n_failed, const iccp_env *env)
{
    icc_status status = n > 0 ? make_ready(loop) : ICC_OK;
    if (status == ICC_OK)
        status = iccp_for_chunks(env, "trace", n, ICCP_CHART_MANY, map_chunk, loop);
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
