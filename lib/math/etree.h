/* Elimination tree of a sparse symmetric matrix. The parent of a column is the row of the first
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
    uint32_t *position; /* the step in which a row is eliminated */
    uint32_t *parent;   /* parent of a column, in elimination order; ICCP_NO_PARENT at a root */
} iccp_etree;

/* Builds the tree from the order. Changes the order to an equivalent one in which every subtree is
 * contiguous, its root last. */
icc_status iccp_etree_build(const iccp_etree *tree, const iccp_env *env);

/* Counts the entries of each column of the factor, including the diagonal. Runs in time nearly
 * linear in the entries of the matrix. */
icc_status iccp_etree_count(const iccp_etree *tree, uint32_t *count, const iccp_env *env);

/* The four passes of an analysis through the matrix. */
enum { ICCP_PASS_ORDER, ICCP_PASS_TREE, ICCP_PASS_COUNT, ICCP_PASS_ROWS, ICCP_N_PASSES };

/* Reports progress from time to time, before column k. */
icc_status iccp_etree_progress(const iccp_etree *tree, int pass, size_t k, const iccp_env *env);

#endif
