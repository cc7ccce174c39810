/* Finds orders of the inside vertices with one critical vertex. */
#ifndef ICCP_GROW_H
#define ICCP_GROW_H

#include "gradient/tree/cousin.h"

/* See icc_tree_grow(). `values` is NULL, or has no NaN inside. Fills in the report except `size`,
 * also for ICC_ERR_TOPOLOGY. */
icc_status iccp_tree_grow(const icc_tree *tree, const double *values, uint32_t *rank,
                          icc_grow_report *report, const iccp_env *env, icc_error *err);

#endif
