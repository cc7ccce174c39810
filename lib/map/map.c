#include "map/map.h"

#include "base/clock.h"
#include "base/error.h"
#include "chart/create.h"

/* The boundaries correspond when their facets join the same vertices and they turn the same way. */
static icc_status check_correspondence(const icc_domain *source, const icc_domain *target,
                                       icc_error *err)
{
    icc_status status = ICC_OK;
    const size_t n_ends = source->n_facets * (size_t)source->dim;
    if (source->dim != target->dim)
        status = iccp_fail(err, ICC_ERR_BOUNDARY, -1,
                           "the source has dimension %ld, the target %ld", (long)source->dim,
                           (long)target->dim);
    else if (source->n_vertices != target->n_vertices || source->n_facets != target->n_facets)
        status = iccp_fail(err, ICC_ERR_BOUNDARY, -1,
                           "the source has %zu vertices, the target %zu: vertex i must "
                           "correspond to vertex i",
                           source->n_vertices, target->n_vertices);
    else if (source->orientation != target->orientation)
        status = iccp_fail(err, ICC_ERR_BOUNDARY, -1,
                           "the source is %s, the target %s: both must turn the same way",
                           source->orientation > 0 ? "counter-clockwise" : "clockwise",
                           target->orientation > 0 ? "counter-clockwise" : "clockwise");
    for (size_t i = 0; status == ICC_OK && i < n_ends; ++i)
        if (source->facets[i] != target->facets[i])
            status = iccp_fail(err, ICC_ERR_BOUNDARY, (int64_t)(i / (size_t)source->dim),
                               "facet %zu does not join the same vertices in the target",
                               i / (size_t)source->dim);
    return status == ICC_OK ? ICC_OK : iccp_fail_side(err, status, 2);
}

static icc_status check_charts(const icc_chart *source, const icc_chart *target, int32_t kind,
                               icc_error *err)
{
    if (kind != 0 && kind != ICC_MAP_CURVES)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, -1, "map kind %ld is not available", (long)kind);
    if (source->info.method != target->info.method)
        return iccp_fail(err, ICC_ERR_UNSUPPORTED, -1,
                         "the charts use different methods (%ld and %ld)",
                         (long)source->info.method, (long)target->info.method);
    return check_correspondence(source->domain, target->domain, err);
}

icc_status iccp_map_create_from_charts(icc_map **out, const icc_chart *source,
                                       const icc_chart *target, int32_t kind, const iccp_env *env,
                                       icc_error *err)
{
    const icc_status status = check_charts(source, target, kind, err);
    if (status != ICC_OK)
        return status;
    icc_map *map = iccp_alloc_zero(&env->memory, 1, sizeof *map);
    if (map == NULL)
        return iccp_fail_memory(err);
    map->memory = env->memory;
    map->source = iccp_chart_retain(source);
    map->target = iccp_chart_retain(target);
    map->info.dim = source->info.dim;
    map->info.kind = ICC_MAP_CURVES;
    map->info.certified = source->info.certified && target->info.certified;
    *out = map;
    return ICC_OK;
}

icc_status iccp_map_create(icc_map **out, const icc_domain *source, const icc_domain *target,
                           int32_t kind, const icc_chart_options *source_options,
                           const icc_chart_options *target_options, const iccp_env *env,
                           icc_error *err)
{
    const double start = iccp_seconds();
    icc_chart *charts[2] = {NULL, NULL};
    icc_status status = check_correspondence(source, target, err);
    if (status != ICC_OK)
        return status;
    const icc_domain *const domains[2] = {source, target};
    const icc_chart_options options[2] = {*source_options, *target_options};
    status = iccp_chart_create_pair(charts, domains, options, env, err);
    if (status == ICC_OK)
        status = iccp_map_create_from_charts(out, charts[0], charts[1], kind, env, err);
    iccp_chart_release(charts[0]);
    iccp_chart_release(charts[1]);
    if (status == ICC_OK)
        (*out)->info.seconds = iccp_seconds() - start;
    return status;
}

void iccp_map_release(icc_map *map)
{
    if (map == NULL)
        return;
    iccp_chart_release(map->source);
    iccp_chart_release(map->target);
    const iccp_memory memory = map->memory;
    iccp_free(&memory, map);
}
