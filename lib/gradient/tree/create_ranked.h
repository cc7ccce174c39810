/* A tree and an order of its vertices with one critical vertex, at the price of a few vertices. */
#ifndef ICCP_CREATE_RANKED_H
#define ICCP_CREATE_RANKED_H

#include "gradient/tree/cousin.h"

/* Makes a tree as iccp_tree_create() does and writes ranks as iccp_tree_grow() does. When growth
 * and thinning get stuck with at most `most_lost` of the vertices inside left, as a share, these
 * become outside and both start again: the tree is then one on a restricted grid, whose n_stray
 * counts what was given up. (Where two parts of a surface come near each other, the vertices inside
 * are not a ball; a vertex or two then close a loop.) Otherwise ICC_ERR_TOPOLOGY. The report is
 * that of the last growth. */
icc_status iccp_tree_create_ranked(icc_tree **out, const icc_grid *grid, uint32_t root,
                                   int32_t form, const int32_t *axis_order, double most_lost,
                                   uint32_t *rank, icc_grow_report *report, const iccp_env *env,
                                   icc_error *err);

#endif
