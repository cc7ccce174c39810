/* Argument checks of the map functions. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "map/curves.h"

icc_status icc_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                          const icc_map_options *options, const icc_env *env, icc_error *err)
{
    if (out != NULL)
        *out = NULL;
    if (out == NULL || source == NULL || target == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1, "icc_map_create: an argument is NULL");
    iccp_env full_env;
    icc_map_options full;
    icc_chart_options chart;
    icc_status status = iccp_env_read(&full_env, env, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&full, sizeof full, options, "icc_map_options", err);
    if (status == ICC_OK)
        status = iccp_read_chart_options(&chart, full.chart, source->dim, err);
    if (status == ICC_OK)
        status = iccp_check_maximum(full.target_maximum, target->dim, err);
    if (status == ICC_OK && chart.method == ICC_METHOD_DISC && full.target_maximum != NULL)
        status = iccp_fail(err, ICC_ERR_ARGUMENT, -1,
                           "method disc has its own maximum: icc_map_options.target_maximum must "
                           "be NULL");
    if (status != ICC_OK)
        return status;
    icc_chart_options target_chart = chart;
    target_chart.maximum = full.target_maximum;
    return iccp_map_create(out, source, target, full.kind, &chart, &target_chart, &full_env, err);
}

icc_status icc_map_create_from_charts(icc_map **out, const icc_chart *source,
                                      const icc_chart *target, const icc_map_options *options,
                                      const icc_env *env, icc_error *err)
{
    if (out != NULL)
        *out = NULL;
    if (out == NULL || source == NULL || target == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, -1,
                         "icc_map_create_from_charts: an argument is NULL");
    iccp_env full_env;
    icc_map_options full;
    icc_status status = iccp_env_read(&full_env, env, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&full, sizeof full, options, "icc_map_options", err);
    return status == ICC_OK ? iccp_map_create_from_charts(out, source, target, full.kind,
                                                          &full_env, err)
                            : status;
}

void icc_map_free(icc_map *map)
{
    iccp_map_release(map);
}

icc_status icc_map_get_info(const icc_map *map, icc_map_info *info)
{
    if (map == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &map->info, sizeof map->info, "icc_map_info", NULL);
}

const icc_chart *icc_map_source_chart(const icc_map *map)
{
    return map != NULL ? map->source : NULL;
}

const icc_chart *icc_map_target_chart(const icc_map *map)
{
    return map != NULL ? map->target : NULL;
}

static icc_status apply(const icc_chart *from, const icc_chart *to, size_t n, const double *points,
                        double *images, icc_status *status, size_t *n_failed, const icc_env *env)
{
    if (n > 0 && (points == NULL || images == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    return read == ICC_OK
               ? iccp_curves_apply(from, to, n, points, images, status, n_failed, &full_env)
               : read;
}

icc_status icc_map_apply(const icc_map *map, size_t n, const double *points, double *images,
                         icc_status *status, size_t *n_failed, const icc_env *env)
{
    return map != NULL
               ? apply(map->source, map->target, n, points, images, status, n_failed, env)
               : ICC_ERR_ARGUMENT;
}

icc_status icc_map_apply_inverse(const icc_map *map, size_t n, const double *points,
                                 double *images, icc_status *status, size_t *n_failed,
                                 const icc_env *env)
{
    return map != NULL
               ? apply(map->target, map->source, n, points, images, status, n_failed, env)
               : ICC_ERR_ARGUMENT;
}

icc_status icc_map_jacobian(const icc_map *map, size_t n, const double *points, double *jacobians,
                            icc_status *status, size_t *n_failed, const icc_env *env)
{
    if (map == NULL || (n > 0 && (points == NULL || jacobians == NULL)))
        return ICC_ERR_ARGUMENT;
    iccp_env full_env;
    const icc_status read = iccp_env_read(&full_env, env, NULL);
    return read == ICC_OK ? iccp_curves_jacobian(map->source, map->target, n, points, jacobians,
                                                 status, n_failed, &full_env)
                          : read;
}
