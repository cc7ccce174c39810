/* Weights that are linear along the edges between handles (Sakaridis, equation 4.3). */
#ifndef LINEAR_EDGES_H
#define LINEAR_EDGES_H

#include "kernel/handle_set.h"

/* Replaces the weights by ones that are linear from end to end at all nodes on edges. If a node is
 * on several edges, the first one counts. The caller frees the old weights. NULL if no node is on
 * an edge. */
icc_status linear_edges_make(icc_weights **out, const icc_weights *weights, const handle_set *set,
                             const icc_env *env, icc_error *err);

#endif
