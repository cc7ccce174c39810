/* The vertices inside as rows of a linear system, numbered as the tree reaches them: row 0 is the
 * root and parents come before their children, so that a forward pass goes from the root to the
 * leaves and a backward pass from the leaves to the root. */
#ifndef ICCP_UNKNOWNS_H
#define ICCP_UNKNOWNS_H

#include "tree/cousin.h"

typedef struct iccp_unknowns {
    iccp_memory memory;
    const icc_tree *tree;   /* borrowed */
    size_t n;               /* the root included; at least 1 */
    int32_t n_neighbours;   /* of each row: 2 dim. A row's diagonal entry in the Laplacian */
    const uint32_t *vertex; /* n: the grid vertex of each row; borrowed from the tree */
    uint32_t *parent;       /* n: a smaller row; ICCP_NONE for row 0 */
    uint32_t *neighbour;    /* n * n_neighbours: rows, or ICCP_NONE for a vertex outside, in the
                               order axis 0 -, axis 0 +, axis 1 -, .. */
} iccp_unknowns;

/* O(vertices * dim) time; 4 + 8 dim bytes a row and, until it returns, 4 bytes a vertex. */
icc_status iccp_unknowns_create(iccp_unknowns *unknowns, const icc_tree *tree, const iccp_env *env);
void iccp_unknowns_free(iccp_unknowns *unknowns);

#endif
