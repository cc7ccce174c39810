/* Parts of a factor that are independent of each other, so that threads can work on them at the
 * same time. */
#ifndef ICCP_SUBTREES_H
#define ICCP_SUBTREES_H

#include "math/supernodes.h"

/* Supernodes [begin, end) with all their descendants: one or more subtrees of the elimination
 * tree. */
typedef struct iccp_subtrees_run {
    uint32_t begin, end;
} iccp_subtrees_run;

/* Runs in rising order. Two kinds of supernodes are in no run: those above all runs, and those too
 * small for a task. */
typedef struct iccp_subtrees {
    size_t n;
    iccp_subtrees_run *run;
    double labour; /* cost of all runs, in the unit of cost() */
} iccp_subtrees;

/* Divides the elimination tree into runs. cost(nodes, s) is the cost of supernode s. A run takes
 * about `share` of the whole cost. Runs do not extend across the ends of the runs of `outer`,
 * unless that is NULL. The result depends on nothing else. On failure nothing stays allocated. */
icc_status iccp_subtrees_create(iccp_subtrees *subtrees, const iccp_supernodes *nodes, double share,
                                const iccp_subtrees *outer,
                                double (*cost)(const iccp_supernodes *nodes, size_t s),
                                const iccp_env *env);
void iccp_subtrees_free(iccp_subtrees *subtrees, const iccp_memory *memory);

#endif
