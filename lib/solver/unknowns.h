/* The vertices inside as unknowns of a linear system, numbered as the tree reaches them: unknown 0
 * is the root, whose value most problems give, and parents come before their children, so that a
 * forward pass goes from the root to the leaves and a backward pass from the leaves to the root. */
#ifndef ICCP_UNKNOWNS_H
#define ICCP_UNKNOWNS_H

#include "tree/cousin.h"

typedef struct iccp_unknowns {
    iccp_memory memory;
    const icc_tree *tree;   /* borrowed */
    size_t n;               /* the root included; at least 1 */
    int32_t n_neighbours;   /* of each unknown: 2 dim. Also the diagonal of the Laplacian */
    const uint32_t *vertex; /* n: the grid vertex of each unknown; borrowed from the tree */
    uint32_t *parent;       /* n: a smaller unknown; ICCP_NONE for the root */
    uint32_t *neighbour;    /* n * n_neighbours: unknowns, or ICCP_NONE for a vertex outside, in the
                               order axis 0 -, axis 0 +, axis 1 -, .. */
} iccp_unknowns;

/* O(vertices * dim) time; 4 + 8 dim bytes an unknown and, until it returns, 4 bytes a vertex. */
icc_status iccp_unknowns_create(iccp_unknowns *unknowns, const icc_tree *tree, const iccp_env *env);
void iccp_unknowns_free(iccp_unknowns *unknowns);

#endif
