/* Checks the arguments of the functions for sampled fields. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "sampled/map_sample.h"
#include "sampled/sampled_certify.h"

/* Checks the shape. All values fit in memory, and all cells have an index of 32 bits. */
static icc_status check_shape(const icc_field *full, icc_error *err)
{
    size_t n = 1;
    for (int32_t k = 0; k < full->dim; ++k) {
        if (full->shape[k] < 2)
            return iccp_fail_at(err, ICC_ERR_ARGUMENT, ICC_ITEM_AXIS, k,
                                "icc_field: axis %ld has %zu samples; it must have at least 2",
                                (long)k, full->shape[k]);
        if (full->shape[k] > UINT32_MAX / n)
            return iccp_fail(err, ICC_ERR_ARGUMENT,
                             "icc_field: the grid has more than 2^32 - 1 samples; split it");
        n *= full->shape[k];
    }
    if (n > PTRDIFF_MAX / (size_t)(full->dim * full->bytes))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_field: %zu samples do not fit in memory", n);
    return ICC_OK;
}

static icc_status read_field(icc_field *full, const icc_field *given, icc_error *err)
{
    const icc_status status = iccp_read_struct(full, sizeof *full, given, "icc_field", err);
    if (status != ICC_OK)
        return status;
    if (full->dim != 2 && full->dim != 3)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_field.dim is %ld; it must be 2 or 3",
                         (long)full->dim);
    if (full->bytes != (int32_t)sizeof(float) && full->bytes != (int32_t)sizeof(double))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_field.bytes is %ld; it must be 4 or 8",
                         (long)full->bytes);
    if (full->displacement < 0 || full->displacement > 1 || full->outside < 0 ||
        full->outside > ICC_OUTSIDE_NEAREST)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_field: displacement %ld or outside %ld is unknown",
                         (long)full->displacement, (long)full->outside);
    if (full->values == NULL)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_field.values is NULL");
    return check_shape(full, err);
}

icc_status icc_map_sample(const icc_map *map, int32_t inverse, const icc_field *field,
                          size_t *n_outside, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    const char *missing = map == NULL ? "map" : field == NULL ? "field" : NULL;
    iccp_env full_env;
    icc_field full;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK && inverse != 0 && inverse != 1)
        status =
            iccp_fail(err, ICC_ERR_ARGUMENT, "inverse is %ld; it must be 0 or 1", (long)inverse);
    if (status == ICC_OK)
        status = read_field(&full, field, err);
    if (status == ICC_OK && map->info.dim != full.dim)
        status =
            iccp_fail(err, ICC_ERR_UNSUPPORTED, "the map has dimension %ld, but the field has %ld",
                      (long)map->info.dim, (long)full.dim);
    if (status != ICC_OK)
        return status;
    return iccp_explain(err, iccp_finish(&full_env, iccp_map_sample(map, inverse == 1, &full,
                                                                    n_outside, &full_env)));
}

icc_status icc_field_certify(const icc_field *field, size_t capacity, uint32_t *cells,
                             int32_t *kinds, icc_field_report *report, const icc_env *env,
                             icc_error *err)
{
    ICCP_ENTER;
    const char *missing = field == NULL                   ? "field"
                          : report == NULL                ? "report"
                          : capacity > 0 && cells == NULL ? "cells"
                          : capacity > 0 && kinds == NULL ? "kinds"
                                                          : NULL;
    iccp_env full_env;
    icc_field full;
    icc_field_report own = {0};
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_write_struct(report, &own, sizeof own, "icc_field_report", err);
    if (status == ICC_OK)
        status = read_field(&full, field, err);
    if (status == ICC_OK)
        status = iccp_sampled_certify(&full, capacity, cells, kinds, &own, &full_env, err);
    if (status == ICC_OK)
        status = iccp_explain(err, iccp_finish(&full_env, ICC_OK));
    return status == ICC_OK ? iccp_write_struct(report, &own, sizeof own, "icc_field_report", err)
                            : status;
}
