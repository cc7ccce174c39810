/* Reads the caller's environment, and places the progress of each part in that of the whole
 * call. */
#include "base/env.h"

#include "base/error.h"
#include "base/minmax.h"
#include "base/options.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

icc_status iccp_env_read(iccp_env *out, const icc_env *env, icc_error *err)
{
    icc_env full;
    icc_status status = iccp_read_struct(&full, sizeof full, env, "icc_env", err);
    if (status != ICC_OK)
        return status;
    if ((full.alloc == NULL) != (full.dealloc == NULL))
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_env: set both alloc and dealloc, or neither");
    if (full.threads < 0 || full.threads > 1024)
        return iccp_fail(err, ICC_ERR_ARGUMENT, "icc_env.threads is %ld; it must lie in 0..1024",
                         (long)full.threads);
    *out = (iccp_env){.memory = iccp_memory_default, .reported = &out->own};
    if (full.alloc != NULL)
        out->memory = (iccp_memory){full.user, full.alloc, full.dealloc};
    out->user = full.user;
    out->log = full.log;
    out->progress = full.progress;
    out->parallel_for = full.parallel_for;
    out->threads = full.threads > 0 ? full.threads : 1;
    out->load_limit = full.load_limit;
    return ICC_OK;
}

iccp_env iccp_part(const iccp_env *env, const char *stage, double from, double to)
{
    iccp_env part = *env;
    const double width = 1 - env->before - env->after;
    part.before += from * width;
    part.after += (1 - to) * width;
    if (part.stage == NULL)
        part.stage = stage;
    return part;
}

void iccp_split(iccp_env *parts, size_t n, const double *cost, const iccp_env *env)
{
    double all = 0, before = 0;
    for (size_t k = 0; k < n; ++k)
        all += cost[k];
    for (size_t k = 0; k < n; before += cost[k++])
        parts[k] = iccp_part(env, NULL, before / all, (before + cost[k]) / all);
}

iccp_env iccp_round(const iccp_env *env, size_t k, double typical)
{
    const double from = (double)k, to = from + 1;
    return iccp_part(env, NULL, from / (from + typical), to / (to + typical));
}

iccp_env iccp_quiet(const iccp_env *env)
{
    iccp_env quiet = *env;
    quiet.progress = NULL;
    return quiet;
}

icc_status iccp_progress(const iccp_env *env, const char *stage, double share)
{
    if (env->progress == NULL)
        return ICC_OK;
    iccp_reported now = {env->stage != NULL ? env->stage : stage,
                         env->before + share * (1 - env->before - env->after)};
    if (env->reported != NULL) {
        now.share = iccp_min(iccp_max(now.share, env->reported->share), 1);
        *env->reported = now;
    }
    return env->progress(env->user, now.stage, now.share) != 0 ? ICC_ERR_CANCELLED : ICC_OK;
}

icc_status iccp_finish(const iccp_env *env, icc_status status)
{
    const iccp_reported *last = env->reported;
    return status == ICC_OK && last->stage != NULL && last->share < 1
               ? iccp_progress(env, last->stage, 1)
               : status;
}

void iccp_log(const iccp_env *env, const char *format, ...)
{
    if (env->log == NULL)
        return;
    char line[240];
    va_list args;
    va_start(args, format);
    (void)vsnprintf(line, sizeof line, format, args);
    va_end(args);
    env->log(env->user, line);
}
