/* Checks the arguments of the match functions. */
#include "api/check.h"
#include "base/error.h"
#include "base/options.h"
#include "match/match_apply.h"
#include "match/match_file.h"
#include "match/outline/landmarks.h"

#include <math.h>
#include <string.h>

ICCP_END(match)

static const double max_drop = .01, max_tolerance = .1;

static icc_status check_options(const icc_match_options *options, icc_error *err)
{
    if (options->turning < 0 || options->turning > ICC_TURNING_FREE)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_match_options.turning is %ld; it must lie in 0..%d",
                         (long)options->turning, (int)ICC_TURNING_FREE);
    if (options->between < 0 || options->between > ICC_BETWEEN_ARC)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_match_options.between is %ld; it must lie in 0..%d",
                         (long)options->between, (int)ICC_BETWEEN_ARC);
    if (!(options->least_sure >= 0 && isfinite(options->least_sure)))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_match_options.least_sure is %g; it must be finite and not negative",
                         options->least_sure);
    if (!(options->drop >= 0 && options->drop <= max_drop))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_match_options.drop is %g; it must lie in [0, %g]", options->drop,
                         max_drop);
    if (!(options->tolerance <= max_tolerance))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_match_options.tolerance is %g; it must be at most %g",
                         options->tolerance, max_tolerance);
    if (options->keep_source < 0 || options->keep_source > 1)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_match_options.keep_source is %ld; it must be 0 or 1",
                         (long)options->keep_source);
    return ICC_OK;
}

icc_status icc_match_create(icc_match **out, const icc_domain *source, const icc_domain *target,
                            size_t n_landmarks, const double *landmarks,
                            const icc_match_options *options, const icc_env *env, icc_error *err)
{
    ICCP_ENTER;
    iccp_env full;
    icc_match_options given;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL                            ? "out"
                          : source == NULL                       ? "source"
                          : target == NULL                       ? "target"
                          : n_landmarks > 0 && landmarks == NULL ? "landmarks"
                                                                 : NULL;
    icc_status status = iccp_begin(&full, env, missing, err);
    if (status == ICC_OK)
        status = iccp_read_struct(&given, sizeof given, options, "icc_match_options", err);
    if (status == ICC_OK && n_landmarks > ICCP_MAX_LANDMARKS)
        status = iccp_fail(err, ICC_ERR_ARGUMENT, "%zu landmarks are too many; at most %d",
                           n_landmarks, ICCP_MAX_LANDMARKS);
    if (status == ICC_OK)
        status = check_options(&given, err);
    if (status != ICC_OK)
        return status;
    return iccp_end_match(
        iccp_match_create(out, source, target, n_landmarks, landmarks, &given, &full, err), out,
        &full, err);
}

void icc_match_free(icc_match *match)
{
    iccp_match_release(match);
}

const icc_domain *icc_match_source(const icc_match *match)
{
    return match != NULL ? match->domain[0] : NULL;
}

const icc_domain *icc_match_target(const icc_match *match)
{
    return match != NULL ? match->domain[1] : NULL;
}

icc_status icc_match_get_info(const icc_match *match, icc_match_info *info)
{
    ICCP_ENTER;
    if (match == NULL || info == NULL)
        return ICC_ERR_ARGUMENT;
    return iccp_write_struct(info, &match->info, sizeof match->info, "icc_match_info", NULL);
}

icc_status icc_match_get_origins(const icc_match *match, uint32_t *source, uint32_t *target)
{
    ICCP_ENTER;
    if (match == NULL)
        return ICC_ERR_ARGUMENT;
    if (source != NULL)
        memcpy(source, match->origin[0], match->n * sizeof *source);
    if (target != NULL)
        memcpy(target, match->origin[1], match->n * sizeof *target);
    return ICC_OK;
}

static icc_status follow(const icc_match *match, int side, size_t n, const double *points,
                         double *images, double *off, const icc_env *env)
{
    iccp_env full;
    if (match == NULL || (n > 0 && (points == NULL || images == NULL)))
        return ICC_ERR_ARGUMENT;
    const icc_status status = iccp_env_read(&full, env, NULL);
    return status == ICC_OK
               ? iccp_finish(&full, iccp_match_apply(match, side, n, points, images, off, &full))
               : status;
}

icc_status icc_match_apply(const icc_match *match, size_t n, const double *points, double *images,
                           double *off, const icc_env *env)
{
    ICCP_ENTER;
    return follow(match, 0, n, points, images, off, env);
}

icc_status icc_match_apply_inverse(const icc_match *match, size_t n, const double *points,
                                   double *images, double *off, const icc_env *env)
{
    ICCP_ENTER;
    return follow(match, 1, n, points, images, off, env);
}

icc_status icc_match_save(const icc_match *match, size_t capacity, void *data, size_t *n_bytes)
{
    ICCP_ENTER;
    if (match == NULL || n_bytes == NULL || (capacity > 0 && data == NULL))
        return ICC_ERR_ARGUMENT;
    iccp_match_save(match, capacity, data, n_bytes);
    return ICC_OK;
}

icc_status icc_match_load(icc_match **out, size_t n_bytes, const void *data, const icc_env *env,
                          icc_error *err)
{
    ICCP_ENTER;
    if (out != NULL)
        *out = NULL;
    const char *missing = out == NULL ? "out" : data == NULL ? "data" : NULL;
    iccp_env full;
    const icc_status status = iccp_begin(&full, env, missing, err);
    return status == ICC_OK
               ? iccp_end_match(iccp_match_load(out, n_bytes, data, &full, err), out, &full, err)
               : status;
}
