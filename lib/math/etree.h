/* The elimination tree of a sparse symmetric matrix: the parent of a column is the row of the first
 * entry below the diagonal in that column of the factor. */
#ifndef ICCP_ETREE_H
#define ICCP_ETREE_H

#include "base/env.h"
#include "math/symmetric.h"

#define ICCP_NO_PARENT UINT32_MAX

/* Arrays of n entries each, borrowed. */
typedef struct iccp_etree {
    const iccp_symmetric *matrix;
    uint32_t *order;    /* the row that is eliminated k-th */
    uint32_t *position; /* when a row is eliminated */
    uint32_t *parent;   /* of a column in eliminated numbering; ICCP_NO_PARENT at a root */
} iccp_etree;

/* From the order to the tree. The order is changed to an equivalent one that lists every subtree
 * without a gap, its root last. */
icc_status iccp_etree_build(const iccp_etree *tree, const iccp_env *env);

/* Entries of each column of the factor, the diagonal among them. Cost: hardly more than the entries
 * of the matrix. */
icc_status iccp_etree_count(const iccp_etree *tree, uint32_t *count, const iccp_env *env);

/* The four passes through the matrix of an analysis. */
enum { ICCP_PASS_ORDER, ICCP_PASS_TREE, ICCP_PASS_COUNT, ICCP_PASS_ROWS, ICCP_N_PASSES };

/* Reports progress now and then, when it is column k's turn. */
icc_status iccp_etree_progress(const iccp_etree *tree, int pass, size_t k, const iccp_env *env);

#endif
