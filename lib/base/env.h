/* The caller's environment, with its defaults filled in. */
#ifndef ICCP_ENV_H
#define ICCP_ENV_H

#include "base/compiler.h"
#include "base/memory.h"
#include "icc/base.h"

/* The last report of a call. */
typedef struct iccp_reported {
    const char *stage; /* NULL: none so far */
    double share;      /* of the whole call */
} iccp_reported;

/* What all functions take. A call consists of parts, which have parts of their own: each has an
 * environment that places its shares among those of the whole call. One that is all zeros but for
 * the callbacks stands for a whole call, too. */
typedef struct iccp_env {
    iccp_memory memory;
    void *user;
    void (*log)(void *user, const char *message);
    int32_t (*progress)(void *user, const char *stage, double share);
    void (*parallel_for)(void *user, size_t n_tasks, icc_task task, void *argument);
    int32_t threads;
    const char *stage;    /* named in place of what the part's own parts are called; NULL: those */
    double before, after; /* shares of the whole call that come before this part and after it */
    struct iccp_team *team;     /* base/team.h; NULL: loops start threads of their own */
    uint64_t load_limit;        /* 0: the default */
    struct iccp_budget *budget; /* base/budget.h; NULL: no limits */
    iccp_reported *reported;    /* of the whole call: shares never fall; NULL: nobody looks */
    iccp_reported own;          /* what `reported` of the whole call points at */
} iccp_env;

/* Checks and completes the caller's env (which may be NULL). `out` must stay where it is during the
 * call. */
icc_status iccp_env_read(iccp_env *out, const icc_env *env, icc_error *err);

/* The part of `env` from one share of it to another, in [0, 1]. All that it reports is of `stage`,
 * unless a part that it belongs to has one; NULL leaves the names to its own parts. Names are those
 * that icc/base.h lists. */
iccp_env iccp_part(const iccp_env *env, const char *stage, double from, double to);

/* Parts that follow one another, by what they cost. */
void iccp_split(iccp_env *parts, size_t n, const double *cost, const iccp_env *env);

/* Round k of who knows how many: `typical` of them are half of the part. */
iccp_env iccp_round(const iccp_env *env, size_t k, double typical);

/* Reports that a share of the part `env` is done; ICC_ERR_CANCELLED when the caller wants to stop.
 * Calling thread only. */
icc_status iccp_progress(const iccp_env *env, const char *stage, double share);

/* The end of a call that returns `status`: one that succeeds has the share 1 for its last report,
 * if it made any. */
icc_status iccp_finish(const iccp_env *env, icc_status status);

/* Sends one line to the caller's log, if there is one. */
void iccp_log(const iccp_env *env, const char *format, ...) ICCP_PRINTF(2, 3);

#endif
