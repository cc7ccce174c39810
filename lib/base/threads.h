/* Parallel loops over chunks of a range. The chunks do not depend on the number of threads. So if
 * chunks write disjoint results, a loop gives the same bits for every number of threads. */
#ifndef ICCP_THREADS_H
#define ICCP_THREADS_H

#include "base/env.h"
#include "base/team.h"

#include <stdbool.h>

/* Works on [begin, end). A status other than ICC_OK stops the loop. The loop then returns the
 * status of the failed chunk with the smallest begin. */
typedef icc_status (*iccp_chunk)(void *argument, size_t begin, size_t end);

/* Makes a copy of `env` whose threads stay alive from one loop to the next, if `env` starts its own
 * threads and has no team yet. Both environments are for the calling thread, and for tasks that it
 * runs side by side, until iccp_without_team(). */
void iccp_with_team(iccp_env *out, iccp_team *team, const iccp_env *env);
void iccp_without_team(const iccp_env *with, const iccp_env *env);

/* Runs chunk() over [0, n) in pieces of `grain`. The calling thread reports progress between
 * pieces. Returns ICC_OK, ICC_ERR_CANCELLED, or what a chunk returned. */
icc_status iccp_for_chunks(const iccp_env *env, const char *stage, size_t n, size_t grain,
                           iccp_chunk chunk, void *argument);

/* Returns true if loops of this environment run on more than one thread. */
static inline bool iccp_has_threads(const iccp_env *env)
{
    return env->threads > 1 || env->parallel_for != NULL;
}

/* One of several independent tasks, such as the two charts of a map. Task k has an environment and
 * an error of its own. */
typedef icc_status (*iccp_side)(void *argument, size_t k, const iccp_env *env, icc_error *err);

enum { ICCP_MOST_SIDES = 2 };

/* Runs task k for every k < n <= ICCP_MOST_SIDES. The tasks run side by side and share the threads;
 * without threads they run in turn. Returns ICC_OK, ICC_ERR_CANCELLED, or the status and error of
 * the first task that failed.
 *
 * Side by side, the tasks do not call the caller's parallel_for again. Their log lines appear when
 * all tasks are done, and only code on the calling thread reports progress. */
icc_status iccp_side_by_side(const iccp_env *env, size_t n, iccp_side task, void *argument,
                             icc_error *err);

#endif
