/* Checks the arguments of the functions on shapes and samplings. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "icc/kernel.h"
#include "kernel/sampling/sampling.h"
#include "kernel/sampling/sampling_file.h"

#include <math.h>

ICCP_END(shape)
ICCP_END(sampling)

static const int32_t MAX_STEPS = 100000;

static icc_status check_finite(size_t n, size_t dim, const double *points, const char *name,
                               icc_error *err)
{
    for (size_t i = 0; i < n; ++i)
        for (size_t k = 0; k < dim; ++k)
            if (!isfinite(points[dim * i + k]))
                return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                    "%s %zu is not finite", name, i);
    return ICC_OK;
}

/* ------------------------------------------------------------------- shape */

static icc_status check_regions(int32_t dim, size_t n_regions, const icc_domain *const *regions,
                                icc_error *err)
{
    for (size_t r = 0; r < n_regions; ++r) {
        if (regions[r] == NULL)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_REGION, (int64_t)r,
                                "regions[%zu] is NULL", r);
        if (regions[r]->dim != dim)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_REGION, (int64_t)r,
                                "region %zu has dimension %ld instead of %ld", r,
                                (long)regions[r]->dim, (long)dim);
        if (regions[r]->features != NULL)
            return iccp_fail_at(
                err, ICC_ERR_UNSUPPORTED, ICC_ITEM_REGION, (int64_t)r,
                "region %zu has holes, lines or points inside, which only mesh maps can have", r);
        if (regions[r]->genus > 0 || regions[r]->n_voids > 0)
            return iccp_fail_at(err, ICC_ERR_TOPOLOGY, ICC_ITEM_REGION, (int64_t)r,
                                "region %zu has handles or voids; it must be a ball", r);
    }
    return ICC_OK;
}

icc_status icc_shape_create(icc_shape **out, int32_t dim, size_t n_regions,
                            const icc_domain *const *regions, size_t n_vertices,
                            const double *vertices, size_t n_segments, const uint32_t *segments,
                            const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL                          ? "out"
                          : n_regions > 0 && regions == NULL   ? "regions"
                          : n_vertices > 0 && vertices == NULL ? "vertices"
                          : n_segments > 0 && segments == NULL ? "segments"
                                                               : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (dim != 2 && dim != 3)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "dim is %ld; it must be 2 or 3", (long)dim);
    if (n_regions == 0 && n_segments == 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "the shape is empty: no region and no segment");
    if (n_regions >= ICCP_NOWHERE)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "there are 2^32 regions or more");
    status = check_regions(dim, n_regions, regions, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_shape(iccp_shape_create(out, dim, n_regions, regions, n_vertices, vertices,
                                            n_segments, segments, &full_env, err),
                          out, &full_env, err);
}

void icc_shape_free(icc_shape *shape)
{
    iccp_shape_release(shape);
}

/* ---------------------------------------------------------------- sampling */

static icc_status check_spread(const icc_sampling_options *o, const icc_shape *shape,
                               icc_error *err)
{
    if (o->kind != ICC_SAMPLING_GRID && o->kind != ICC_SAMPLING_BLUE)
        return iccp_fail(
            err, ICC_ERR_ARGUMENT,
            "icc_sampling_options.kind is %ld; it must be ICC_SAMPLING_BLUE or ICC_SAMPLING_GRID",
            (long)o->kind);
    if (o->kind == ICC_SAMPLING_GRID && shape->n_regions == 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "a grid samples regions, but there are none");
    if (o->steps < -1 || o->steps > MAX_STEPS)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_sampling_options.steps is %ld; it must lie in -1..%ld",
                         (long)o->steps, (long)MAX_STEPS);
    if (!(o->spacing >= 0 && isfinite(o->spacing)))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_sampling_options.spacing is %g; it must be positive", o->spacing);
    if (!(o->margin >= 0 && isfinite(o->margin)))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_sampling_options.margin is %g; it must not be negative", o->margin);
    return ICC_OK;
}

static icc_status read_options(icc_sampling_options *full, const icc_sampling_options *options,
                               const icc_shape *shape, icc_error *err)
{
    icc_status status = iccp_read_struct(full, sizeof *full, options, "icc_sampling_options", err);
    if (status != ICC_OK)
        return status;
    full->kind = full->kind == 0 ? ICC_SAMPLING_BLUE : full->kind;
    status = check_spread(full, shape, err);
    if (status != ICC_OK)
        return status;
    if (full->n_fixed > 0 && full->fixed == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_sampling_options.fixed is NULL");
    if (full->n_fixed > 0 && full->kind == ICC_SAMPLING_GRID)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "a grid has no fixed points");
    return check_finite(full->n_fixed, shape->dim, full->fixed, "fixed point", err);
}

icc_status icc_sampling_create(icc_sampling **out, const icc_shape *shape,
                               const icc_sampling_options *options, const icc_env *env,
                               icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    icc_sampling_options full;
    const char *missing = out == NULL ? "out" : shape == NULL ? "shape" : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = read_options(&full, options, shape, err);
    return status == ICC_OK
               ? iccp_end_sampling(iccp_sampling_create(out, shape, &full, &full_env, err), out,
                                   &full_env, err)
               : status;
}

icc_status icc_sampling_create_from_points(icc_sampling **out, const icc_shape *shape, size_t n,
                                           const double *points, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL      ? "out"
                          : shape == NULL  ? "shape"
                          : points == NULL ? "points"
                                           : NULL;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (n == 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "there is no point");
    if (n > (size_t)1 << 24)
        return iccp_fail(err, ICC_ERR_RESOLUTION, "there are more than 2^24 points");
    status = check_finite(n, shape->dim, points, "point", err);
    if (status != ICC_OK)
        return status;
    return iccp_end_sampling(
        iccp_sampling_create_from_points(out, shape, n, points, &full_env, err), out, &full_env,
        err);
}

void icc_sampling_free(icc_sampling *sampling)
{
    iccp_sampling_release(sampling);
}

icc_status icc_sampling_get_info(const icc_sampling *sampling, icc_sampling_info *info)
{
    ICCP_ENTER;
    if (sampling == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &sampling->info, sizeof sampling->info, "icc_sampling_info",
                             NULL);
}

icc_status icc_sampling_get_points(const icc_sampling *sampling, double *points)
{
    ICCP_ENTER;
    if (sampling == NULL || points == NULL)
        return ICC_ERR_ARGUMENT;
    const size_t n = sampling->info.n_samples * sampling->shape->dim;
    for (size_t i = 0; i < n; ++i)
        points[i] = sampling->points[i];
    return ICC_OK;
}

icc_status icc_sampling_save(const icc_sampling *sampling, size_t capacity, void *data,
                             size_t *n_bytes)
{
    ICCP_ENTER;
    if (sampling == NULL || n_bytes == NULL || (capacity > 0 && data == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_sampling_save(sampling, capacity, data, n_bytes);
    return ICC_OK;
}

icc_status icc_sampling_load(icc_sampling **out, size_t n_bytes, const void *data,
                             const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL ? "out" : data == NULL ? "data" : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    return status == ICC_OK
               ? iccp_end_sampling(iccp_sampling_load(out, n_bytes, data, &full_env, err), out,
                                   &full_env, err)
               : status;
}
