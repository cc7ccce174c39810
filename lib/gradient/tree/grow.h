/* Finds orders of the inside vertices with one critical vertex. */
#ifndef ICCP_GROW_H
#define ICCP_GROW_H

#include "gradient/tree/cousin.h"

/* See icc_tree_grow(). `values` is NULL, or has no NaN inside. Fills in the report except `size`,
 * also for ICC_ERR_TOPOLOGY. */
icc_status iccp_tree_grow(const icc_tree *tree, const double *values, uint32_t *rank,
                          icc_grow_report *report, const iccp_env *env, icc_error *err);

/* Makes a tree as iccp_tree_create() does, and writes ranks as iccp_tree_grow() does. Suppose that
 * growing and thinning get stuck, but leave at most the share `most_lost` of the inside vertices.
 * Then these vertices become outside, and both start again. The tree is then one on a restricted
 * grid, whose n_stray counts the vertices lost. Otherwise returns ICC_ERR_TOPOLOGY. The report is
 * that of the last growth.
 *
 * Vertices are lost where two parts of a surface come near each other. The inside vertices are then
 * not a ball, because one or two of them close a loop. */
icc_status iccp_tree_create_ranked(icc_tree **out, const icc_grid *grid, uint32_t root,
                                   int32_t form, const int32_t *axis_order, double most_lost,
                                   uint32_t *rank, icc_grow_report *report, const iccp_env *env,
                                   icc_error *err);

#endif
