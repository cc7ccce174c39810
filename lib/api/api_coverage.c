/* Checks the arguments of the coverage functions. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "domain/domain.h"
#include "match/coverage/coverage_object.h"

#include <math.h>

ICCP_END(coverage)

/* Checks where the rings of a layer begin. */
static icc_status check_rings(const icc_layer *layer, icc_error *err)
{
    if (layer->first[0] != 0)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_layer.first begins with %zu, not with 0",
                         layer->first[0]);
    for (size_t r = 0; r < layer->n_rings; ++r)
        if (layer->first[r + 1] < layer->first[r] || layer->first[r + 1] - layer->first[r] < 3)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)r,
                                "ring %zu has fewer than 3 vertices", r);
        else if (layer->first[r + 1] > ICCP_MAX_COUNT)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_LINE, (int64_t)r,
                                "too many vertices up to ring %zu; at most %zu in all", r,
                                ICCP_MAX_COUNT);
    return ICC_OK;
}

/* Reads one of the caller's layers. */
static icc_status read_layer(icc_layer *full, const icc_layer *layer, icc_error *err)
{
    icc_status status = iccp_read_struct(full, sizeof *full, layer, "icc_layer", err);
    if (status != ICC_OK)
        return status;
    if (full->n_rings == 0 || full->n_rings > ICCP_MAX_COUNT)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_layer.n_rings is %zu; it must lie in 1..%zu",
                         full->n_rings, ICCP_MAX_COUNT);
    const char *const missing = full->first == NULL      ? "first"
                                : full->vertices == NULL ? "vertices"
                                : full->ids == NULL      ? "ids"
                                                         : NULL;
    if (missing != NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_layer.%s is NULL", missing);
    status = check_rings(full, err);
    for (size_t k = 0; status == ICC_OK && k < 2 * full->first[full->n_rings]; ++k)
        if (!isfinite(full->vertices[k]))
            status = iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_VERTEX, (int64_t)(k / 2),
                                  "vertex %zu is not finite", k / 2);
    return status;
}

static icc_status check_options(const icc_coverage_options *options, icc_error *err)
{
    for (int e = 0; e < 2; ++e)
        if (!(options->weld[e] >= 0 && isfinite(options->weld[e])))
            return iccp_fail(err, ICC_ERR_ARGUMENT,
                             "icc_coverage_options.weld[%d] is %g; it must be finite and not "
                             "negative",
                             e, options->weld[e]);
    if (options->between < 0 || options->between > ICC_BETWEEN_ARC)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_coverage_options.between is %ld; it must lie in 0..%d",
                         (long)options->between, (int)ICC_BETWEEN_ARC);
    if (options->unmatched < 0 || options->unmatched > ICC_UNMATCHED_LEAVE_OUT)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_coverage_options.unmatched is %ld; it must lie in 0..%d",
                         (long)options->unmatched, (int)ICC_UNMATCHED_LEAVE_OUT);
    if (options->n_left_out > 0 && options->left_out == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_coverage_options.left_out is NULL");
    return ICC_OK;
}

icc_status icc_coverage_create(icc_coverage **out, const icc_layer *source, const icc_layer *target,
                               const icc_coverage_options *options, const icc_env *env,
                               icc_error *err)
{
    ICCP_ENTER;
    iccp_env full;
    icc_layer layer[2];
    icc_coverage_options given;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL      ? "out"
                          : source == NULL ? "source"
                          : target == NULL ? "target"
                                           : NULL;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&given, sizeof given, options, "icc_coverage_options", err);
    if (status == ICC_OK)
        status = check_options(&given, err);
    for (int e = 0; e < 2 && status == ICC_OK; ++e) {
        status = read_layer(&layer[e], e == 0 ? source : target, err);
        if (status != ICC_OK)
            return iccp_fail_side(err, status, e + 1);
    }
    if (status != ICC_OK)
        return status;
    return iccp_end_coverage(iccp_coverage_create(out, &layer[0], &layer[1], &given, &full, err),
                             out, &full, err);
}

void icc_coverage_free(icc_coverage *coverage)
{
    iccp_coverage_release(coverage);
}

const icc_domain *icc_coverage_source(const icc_coverage *coverage)
{
    return coverage != NULL ? coverage->domain[0] : NULL;
}

const icc_domain *icc_coverage_target(const icc_coverage *coverage)
{
    return coverage != NULL ? coverage->domain[1] : NULL;
}

icc_status icc_coverage_get_info(const icc_coverage *coverage, icc_coverage_info *info)
{
    ICCP_ENTER;
    if (coverage == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &coverage->info, sizeof coverage->info, "icc_coverage_info",
                             NULL);
}

icc_status icc_coverage_get_features(const icc_coverage *coverage, const icc_feature **source,
                                     const icc_feature **target)
{
    ICCP_ENTER;
    if (coverage == NULL)
        return ICC_ERR_ARGUMENT;
    if (source != NULL)
        *source = coverage->feature[0];
    if (target != NULL)
        *target = coverage->feature[1];
    return ICC_OK;
}

icc_status icc_coverage_get_ids(const icc_coverage *coverage, int64_t *ids)
{
    ICCP_ENTER;
    if (coverage == NULL || ids == NULL)
        return ICC_ERR_ARGUMENT;
    for (size_t f = 0; f < coverage->n_features; ++f)
        ids[f] = coverage->id[f];
    return ICC_OK;
}

icc_status icc_coverage_get_difference(const icc_coverage *coverage, size_t k,
                                       icc_coverage_difference *difference)
{
    ICCP_ENTER;
    if (coverage == NULL || difference == NULL || k >= coverage->info.n_differences)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(difference, &coverage->difference[k], sizeof *coverage->difference,
                             "icc_coverage_difference", NULL);
}
