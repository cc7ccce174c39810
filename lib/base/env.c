#include "base/env.h"

#include "base/error.h"
#include "base/options.h"

#include <stdarg.h>
#include <stdio.h>

icc_status iccp_env_read(iccp_env *out, const icc_env *env, icc_error *err)
{
    icc_env full;
    icc_status status = iccp_read_struct(&full, sizeof full, env, "icc_env", err);
    if (status != ICC_OK)
        return status;
    if ((full.alloc == NULL) != (full.dealloc == NULL))
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_env: set both alloc and dealloc, or neither");
    if (full.threads < 0 || full.threads > 1024)
        return iccp_fail(err, ICC_ERR_ARGUMENT,
                         "icc_env.threads is %ld; it must lie in 0..1024", (long)full.threads);
    out->memory = iccp_memory_default;
    if (full.alloc != NULL)
        out->memory = (iccp_memory){full.user, full.alloc, full.dealloc};
    out->user = full.user;
    out->log = full.log;
    out->progress = full.progress;
    out->parallel_for = full.parallel_for;
    out->threads = full.threads > 0 ? full.threads : 1;
    return ICC_OK;
}

icc_status iccp_progress(const iccp_env *env, const char *stage, double share)
{
    if (env->progress != NULL && env->progress(env->user, stage, share) != 0)
        return ICC_ERR_CANCELLED;
    return ICC_OK;
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
