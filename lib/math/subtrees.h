/* Parts of a factor that do not depend on one another. */
#ifndef ICCP_SUBTREES_H
#define ICCP_SUBTREES_H

#include "math/supernodes.h"

/* Supernodes [begin, end) with all their descendants, one or more subtrees of the elimination
 * tree. */
typedef struct iccp_subtrees_run {
    uint32_t begin, end;
} iccp_subtrees_run;

/* Rising, and without what is in none: the supernodes above them all, and what is not worth a task
 * of its own. */
typedef struct iccp_subtrees {
    size_t n;
    iccp_subtrees_run *run;
    double labour; /* of all of them, as the supernodes' */
} iccp_subtrees;

/* cost(nodes, s): what supernode s takes; `share`: of the whole, what a run may take, about. Runs
 * do not reach across the ends of those of `outer`, unless that is NULL. Depends on nothing else.
 * On failure nothing is left allocated. */
icc_status iccp_subtrees_create(iccp_subtrees *subtrees, const iccp_supernodes *nodes, double share,
                                const iccp_subtrees *outer,
                                double (*cost)(const iccp_supernodes *nodes, size_t s),
                                const iccp_env *env);
void iccp_subtrees_free(iccp_subtrees *subtrees, const iccp_memory *memory);

#endif
