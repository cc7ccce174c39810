/* Parallel loops over chunks of a range. The chunks do not depend on the number of threads, so a
 * loop whose chunks write disjoint results gives the same bits for every number of threads. */
#ifndef ICCP_THREADS_H
#define ICCP_THREADS_H

#include "base/env.h"

/* Works on [begin, end). A status other than ICC_OK stops the loop; the chunk with the smallest
 * begin that failed decides what the loop returns. */
typedef icc_status (*iccp_chunk)(void *argument, size_t begin, size_t end);

/* Runs chunk() over [0, n) in pieces of `grain`, reporting progress between pieces from the
 * calling thread. Returns ICC_OK, ICC_ERR_CANCELLED, or what a chunk returned. */
icc_status iccp_for_chunks(const iccp_env *env, const char *stage, size_t n, size_t grain,
                           iccp_chunk chunk, void *argument);

#endif
