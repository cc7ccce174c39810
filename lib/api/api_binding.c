/* Checks the arguments of the functions on bindings and poses (kernel coordinates). */
#include "api/check.h"
#include "base/error.h"
#include "kernel/pose/pose.h"

#include <math.h>

ICCP_END(binding)

static bool are_finite(size_t n, const double *values)
{
    for (size_t i = 0; i < n; ++i)
        if (!isfinite(values[i]))
            return false;
    return true;
}

icc_status icc_binding_create(icc_binding **out, const icc_weights *weights, size_t n,
                              const double *points, int32_t derivatives, const icc_env *env,
                              icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    iccp_env full_env;
    const char *missing = out == NULL               ? "out"
                          : weights == NULL         ? "weights"
                          : n > 0 && points == NULL ? "points"
                                                    : NULL;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    if (derivatives < 0 || derivatives > 1)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "derivatives is %ld; it must be 0 or 1",
                         (long)derivatives);
    for (size_t i = 0, dim = weights->nodes->dim; i < n; ++i)
        if (!are_finite(dim, points + dim * i))
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_POINT, (int64_t)i,
                                "point %zu is not finite", i);
    return iccp_end_binding(iccp_explain(err, iccp_binding_create(out, weights, n, points,
                                                                  derivatives == 1, &full_env)),
                            out, &full_env, err);
}

void icc_binding_free(icc_binding *binding)
{
    iccp_binding_release(binding);
}

icc_status icc_binding_get_counts(const icc_binding *binding, size_t *n_points, size_t *n_handles,
                                  int32_t *dim)
{
    ICCP_ENTER;
    if (binding == NULL)
        return ICC_ERR_ARGUMENT;
    if (n_points != NULL)
        *n_points = binding->n;
    if (n_handles != NULL)
        *n_handles = binding->n_handles;
    if (dim != NULL)
        *dim = (int32_t)binding->dim;
    return ICC_OK;
}

icc_status icc_binding_get_weights(const icc_binding *binding, double *handles, double *weights)
{
    ICCP_ENTER;
    if (binding == NULL)
        return ICC_ERR_ARGUMENT;
    for (size_t k = 0; handles != NULL && k < binding->n_handles * binding->dim; ++k)
        handles[k] = binding->handles[k];
    for (size_t k = 0; weights != NULL && k < binding->n * binding->n_handles; ++k)
        weights[k] = binding->weights[k];
    return ICC_OK;
}

icc_status icc_binding_pose(const icc_binding *binding, const double *transforms, double *images,
                            double *jacobians, const icc_env *env)
{
    ICCP_ENTER;
    if (binding == NULL || transforms == NULL || (binding->n > 0 && images == NULL) ||
        !are_finite(binding->n_handles * binding->dim * (binding->dim + 1), transforms))
        return ICC_ERR_ARGUMENT;
    if (jacobians != NULL && binding->gradients == NULL)
        return ICC_ERR_UNSUPPORTED;
    iccp_env full_env;
    const icc_status status = iccp_env_read(&full_env, env, NULL);
    return status == ICC_OK ? iccp_finish(&full_env, iccp_binding_pose(binding, transforms, images,
                                                                       jacobians, &full_env))
                            : status;
}

icc_status icc_binding_save(const icc_binding *binding, size_t capacity, void *data,
                            size_t *n_bytes)
{
    ICCP_ENTER;
    if (binding == NULL || n_bytes == NULL || (capacity > 0 && data == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_binding_save(binding, capacity, data, n_bytes);
    return ICC_OK;
}

icc_status icc_binding_load(icc_binding **out, size_t n_bytes, const void *data, const icc_env *env,
                            icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : n_bytes > 0 && data == NULL ? "data" : NULL;
    iccp_env full_env;
    const icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_binding(
        iccp_explain(err, iccp_binding_load(out, n_bytes, data, &full_env, err)), out, &full_env,
        err);
}

/* ---- poses ---- */

icc_status icc_pose_reset(int32_t dim, size_t n_handles, double *transforms)
{
    ICCP_ENTER;
    if (dim < 2 || dim > 3 || (n_handles > 0 && transforms == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_pose_reset((size_t)dim, n_handles, transforms);
    return ICC_OK;
}

icc_status icc_pose_move(int32_t dim, double *transform, const double *offset)
{
    ICCP_ENTER;
    if (dim < 2 || dim > 3 || transform == NULL || offset == NULL ||
        !are_finite((size_t)dim, offset))
        return ICC_ERR_ARGUMENT;
    iccp_pose_move((size_t)dim, transform, offset);
    return ICC_OK;
}

icc_status icc_pose_turn(int32_t dim, double *transform, const double *handle, const double *axis,
                         double angle)
{
    ICCP_ENTER;
    if (dim < 2 || dim > 3 || transform == NULL || handle == NULL ||
        !are_finite((size_t)dim, handle) || !isfinite(angle))
        return ICC_ERR_ARGUMENT;
    if (dim == 3 && (axis == NULL || !are_finite(3, axis) ||
                     !(fabs(axis[0]) > 0 || fabs(axis[1]) > 0 || fabs(axis[2]) > 0)))
        return ICC_ERR_ARGUMENT;
    iccp_pose_turn((size_t)dim, transform, handle, axis, angle);
    return ICC_OK;
}
