/* Checks and uses an order of a tree's vertices that is given by ranks: 0 for the highest,
 * ICCP_NONE for vertices without a rank. */
#ifndef ICCP_RANKS_H
#define ICCP_RANKS_H

#include "gradient/tree/cousin.h"

/* See icc_tree_get_rank_report(). Fills in everything but `size`. */
icc_status iccp_tree_verify_ranks(const icc_tree *tree, const uint32_t *rank,
                                  icc_function_report *report, const iccp_env *env);

/* Lowers values, one per grid vertex, as little as possible so that the function falls with the
 * ranks. It then falls by at least `gap` along every edge of the Kuhn triangulation between two
 * vertices with ranks. If values are logarithms of a positive function, `gap` is a share of it.
 * Then the function has the critical vertices of the order. Ranks are different, and less than
 * tree->n_inside. */
icc_status iccp_tree_lower(const icc_tree *tree, const uint32_t *rank, double gap, double *values,
                           const iccp_env *env);

#endif
