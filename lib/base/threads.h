/* Parallel loops over chunks of a range. The chunks do not depend on the number of threads, so a
 * loop whose chunks write disjoint results gives the same bits for every number of threads. */
#ifndef ICCP_THREADS_H
#define ICCP_THREADS_H

#include "base/env.h"
#include "base/team.h"

#include <stdbool.h>

/* Works on [begin, end). A status other than ICC_OK stops the loop; the chunk with the smallest
 * begin that failed decides what the loop returns. */
typedef icc_status (*iccp_chunk)(void *argument, size_t begin, size_t end);

/* The same environment with threads that stay from one loop to the next, if it is one that starts
 * its own and has none yet. Both are for the calling thread, and for tasks that it runs side by
 * side, until iccp_without_team(). */
void iccp_with_team(iccp_env *out, iccp_team *team, const iccp_env *env);
void iccp_without_team(const iccp_env *with, const iccp_env *env);

/* Runs chunk() over [0, n) in pieces of `grain`, reporting progress between pieces from the
 * calling thread. Returns ICC_OK, ICC_ERR_CANCELLED, or what a chunk returned. */
icc_status iccp_for_chunks(const iccp_env *env, const char *stage, size_t n, size_t grain,
                           iccp_chunk chunk, void *argument);

/* Whether a loop of this environment runs on more than one thread. */
static inline bool iccp_has_threads(const iccp_env *env)
{
    return env->threads > 1 || env->parallel_for != NULL;
}

/* Tasks that do not depend on one another, such as the two charts of a map: the k-th of them, in an
 * environment and with an error of its own. */
typedef icc_status (*iccp_side)(void *argument, size_t k, const iccp_env *env, icc_error *err);

enum { ICCP_MOST_SIDES = 2 };

/* Runs task k for every k < n <= ICCP_MOST_SIDES: side by side where there are threads, which the
 * tasks share, and else one after the other. Side by side, a caller's parallel_for is not called
 * again inside them, what they log comes when all are done, and only what runs on the calling
 * thread reports progress. Returns ICC_OK, ICC_ERR_CANCELLED, or what the first task that failed
 * returned, with its error. */
icc_status iccp_side_by_side(const iccp_env *env, size_t n, iccp_side task, void *argument,
                             icc_error *err);

#endif
