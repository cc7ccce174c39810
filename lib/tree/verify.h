/* Does the cousin rule (Definition 2 of the paper) hold? */
#ifndef ICCP_VERIFY_H
#define ICCP_VERIFY_H

#include "tree/cousin.h"

/* Fills in everything but `size`. */
icc_status iccp_tree_verify(const icc_tree *tree, icc_tree_report *report, const iccp_env *env);

#endif
