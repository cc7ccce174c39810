/* The caller's environment, with its defaults filled in. */
#ifndef ICCP_ENV_H
#define ICCP_ENV_H

#include "base/compiler.h"
#include "base/memory.h"
#include "icc/base.h"

typedef struct iccp_env {
    iccp_memory memory;
    void *user;
    void (*log)(void *user, const char *message);
    int32_t (*progress)(void *user, const char *stage, double share);
    void (*parallel_for)(void *user, size_t n_tasks, icc_task task, void *argument);
    int32_t threads;
} iccp_env;

/* Checks and completes the caller's env (which may be NULL). */
icc_status iccp_env_read(iccp_env *out, const icc_env *env, icc_error *err);

/* Reports progress; ICC_ERR_CANCELLED when the caller wants to stop. Calling thread only. */
icc_status iccp_progress(const iccp_env *env, const char *stage, double share);

/* Sends one line to the caller's log, if there is one. */
void iccp_log(const iccp_env *env, const char *format, ...) ICCP_PRINTF(2, 3);

#endif
