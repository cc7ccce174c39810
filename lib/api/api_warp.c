/* Checks the arguments of icc_map_warp(). */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "map/picture/picture_values.h"
#include "map/picture/warp.h"

/* Reads a picture struct of the caller's version. Refuses a picture whose pixels would not fit
 * in memory, because the functions below api/ rely on all width * height pixels. */
static icc_status read_picture(icc_picture *full, const icc_picture *given, icc_error *err)
{
    const icc_status status = iccp_read_struct(full, sizeof *full, given, "icc_picture", err);
    if (status != ICC_OK)
        return status;
    if (full->width < 1 || full->height < 1)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "the picture has %ld x %ld pixels; it must have at least 1 x 1",
                         (long)full->width, (long)full->height);
    if (full->channels < 1 || full->channels > ICCP_MOST_CHANNELS)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "the picture has %ld channels; there must be 1 to %d",
                         (long)full->channels, (int)ICCP_MOST_CHANNELS);
    if (full->bytes != 1 && full->bytes != 2 && full->bytes != 4 && full->bytes != 8)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "a sample of the picture has %ld bytes; it must have 1, 2, 4 or 8",
                         (long)full->bytes);
    if (full->alpha < 0 || full->alpha > 1 || full->alpha >= full->channels)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_picture: alpha is %ld with %ld channels; it must be 0, or 1 with at "
                         "least two channels",
                         (long)full->alpha, (long)full->channels);
    if (full->interpolation < 0 || full->interpolation > ICC_INTERPOLATION_CUBIC ||
        full->has_nodata < 0 || full->has_nodata > 1)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_picture: interpolation %ld or has_nodata %ld is unknown",
                         (long)full->interpolation, (long)full->has_nodata);
    if (full->alpha && full->interpolation != ICC_INTERPOLATION_NEAREST &&
        iccp_picture_has_values(full))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_picture: alpha needs at most 4 channels of 1 or 2 bytes, linear or "
                         "nearest interpolation, and no nodata");
    const size_t pixel = (size_t)(full->channels * full->bytes);
    if (full->pixels == NULL || full->stride / pixel < (size_t)full->width ||
        full->stride > PTRDIFF_MAX / (size_t)full->height)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "the picture has no pixels, or a stride of %zu bytes does not fit",
                         full->stride);
    return ICC_OK;
}

icc_status icc_map_warp(const icc_map *map, const icc_picture *source, const icc_picture *target,
                        size_t *n_failed, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    const char *missing = map == NULL      ? "map"
                          : source == NULL ? "source"
                          : target == NULL ? "target"
                                           : NULL;
    iccp_env full_env;
    icc_picture from, to;
    icc_status status = iccp_begin(&full_env, env, missing, err);
    if (status == ICC_OK)
        status = iccp_fail_side(err, read_picture(&from, source, err), 1);
    if (status == ICC_OK)
        status = iccp_fail_side(err, read_picture(&to, target, err), 2);
    if (status == ICC_OK &&
        (from.channels != to.channels || from.bytes != to.bytes || from.alpha != to.alpha))
        status =
            iccp_fail(err, ICC_ERR_ARGUMENT, "the pictures differ in channels, bytes or alpha");
    if (status == ICC_OK && map->info.dim != 2)
        status = iccp_fail(err, ICC_ERR_UNSUPPORTED, "a map of dimension %ld cannot warp a picture",
                           (long)map->info.dim);
    if (status != ICC_OK)
        return status;
    return iccp_explain(
        err, iccp_finish(&full_env, iccp_map_warp(map, &from, &to, n_failed, &full_env)));
}
