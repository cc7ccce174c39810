/* Checks the cousin rule (Definition 2 of the paper). */
#ifndef ICCP_VERIFY_H
#define ICCP_VERIFY_H

#include "gradient/tree/cousin.h"

/* See icc_tree_get_report(). Fills in everything except `size`. ICC_ERR_MEMORY and
 * ICC_ERR_CANCELLED leave the report unchanged. */
icc_status iccp_tree_verify(const icc_tree *tree, icc_tree_report *report, const iccp_env *env);

#endif
