/* The caller's environment, with its defaults filled in.
 *
 * Words of this folder, which knows nothing of geometry. Begin with this file.
 * - environment: memory functions, callbacks and threads of one call. Each function that allocates,
 *   reports or runs loops takes one.
 * - part: the environment of one step of a call. It maps the step's progress from 0 to 1 into the
 *   progress of the whole call.
 * - share: a fraction of a call's work, in [0, 1].
 * - stage: the name of a step that the progress callback sees.
 * - chunk, job, team: a piece of a parallel loop (threads.h), a loop that other threads may help
 *   with, and these threads (team.h).
 * - budget: limits of memory and time for rebuilding objects from bytes (budget.h).
 * - blob: an object as bytes (blob.h).
 * - fail: functions that describe a failure in the caller's icc_error and return its status
 *   (error.h).
 *
 * Ways: memory.h allocates, error.h fails, threads.h runs loops. options.h reads and writes structs
 * of the caller's version, blob.h objects as bytes, within the limits of budget.h. fpenv.h sets the
 * floating-point environment, simd.h chooses instructions, clock.h measures. For algorithms:
 * heap.h, sort.h, sets.h (union-find), random.h, minmax.h, and once.h for what is made on first
 * use.
 *
 * Invariants: results do not depend on the number of threads. No variables keep state between
 * calls. Allocations whose size overflows fail (memory.h). */
#ifndef ICCP_ENV_H
#define ICCP_ENV_H

#include "base/compiler.h"
#include "base/memory.h"
#include "icc/base.h"

/* The last progress report of a call. */
typedef struct iccp_reported {
    const char *stage; /* NULL: none yet */
    double share;      /* of the whole call */
} iccp_reported;

/* The environment that all functions take. A call consists of parts, which have parts of their own.
 * Each part has an environment that places its shares among those of the whole call. An environment
 * that is all zeros except for the callbacks also stands for a whole call. */
typedef struct iccp_env {
    iccp_memory memory;
    void *user;
    void (*log)(void *user, const char *message);
    int32_t (*progress)(void *user, const char *stage, double share);
    void (*parallel_for)(void *user, size_t n_tasks, icc_task task, void *argument);
    int32_t threads;
    const char *stage;          /* replaces the stage names of the part's own parts, unless NULL */
    double before, after;       /* shares of the whole call before and after this part */
    struct iccp_team *team;     /* base/team.h; NULL: loops start threads of their own */
    uint64_t load_limit;        /* 0: the default */
    struct iccp_budget *budget; /* base/budget.h; NULL: no limits */
    iccp_reported *reported;    /* shared by all parts, so that shares never fall; NULL: unused */
    iccp_reported own;          /* where `reported` of the whole call points */
} iccp_env;

/* Checks the caller's env, which may be NULL, and fills in defaults. `out` must keep its address
 * during the call. */
icc_status iccp_env_read(iccp_env *out, const icc_env *env, icc_error *err);

/* Returns the part of `env` from share `from` to share `to`, in [0, 1]. All its reports carry the
 * name `stage`, unless a part that contains it has a name already. NULL leaves the names to its own
 * parts. icc/base.h lists the names. */
iccp_env iccp_part(const iccp_env *env, const char *stage, double from, double to);

/* Makes n consecutive parts whose shares are proportional to their costs. */
void iccp_split(iccp_env *parts, size_t n, const double *cost, const iccp_env *env);

/* Returns `env` without progress. The steps that finish a result run with it, so that a callback
 * which still asks to stop does not lose the result. */
iccp_env iccp_quiet(const iccp_env *env);

/* Returns the part for round k of an unknown number of rounds. The first `typical` rounds take half
 * of `env`. */
iccp_env iccp_round(const iccp_env *env, size_t k, double typical);

/* Reports that a share of the part `env` is done. Returns ICC_ERR_CANCELLED when the caller wants
 * to stop. For the calling thread only. */
icc_status iccp_progress(const iccp_env *env, const char *stage, double share);

/* Ends a call and returns `status`. If the call succeeded and has reported progress, it reports the
 * share 1. */
icc_status iccp_finish(const iccp_env *env, icc_status status);

/* Sends one line to the caller's log, if there is one. */
void iccp_log(const iccp_env *env, const char *format, ...) ICCP_PRINTF(2, 3);

#endif
