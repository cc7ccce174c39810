/* The vertices inside as unknowns of a linear system, numbered as the tree reaches them: unknown 0
 * is the root, whose value most problems give, and parents come before their children, so that a
 * forward pass goes from the root to the leaves and a backward pass from the leaves to the root. */
#ifndef ICCP_UNKNOWNS_H
#define ICCP_UNKNOWNS_H

#include "gradient/tree/cousin.h"

typedef struct iccp_unknowns {
    iccp_memory memory;
    const icc_tree *tree;   /* borrowed */
    size_t n;               /* the root included; at least 1 */
    int32_t n_neighbours;   /* of each unknown: 2 dim. Also the diagonal of the Laplacian */
    const uint32_t *vertex; /* n: the grid vertex of each unknown; borrowed from the tree */
    uint32_t *parent;       /* n: a smaller unknown; ICCP_NONE for the root */
    uint32_t *neighbour;    /* n * n_neighbours: unknowns, or ICCP_NONE for a vertex outside, in the
                               order axis 0 -, axis 0 +, axis 1 -, .. */
    double *reach;          /* n * n_neighbours, or NULL: 1 everywhere. On which share of the way to
                               a neighbour outside the function is 0, in (0, 1] */
} iccp_unknowns;

/* O(vertices * dim) time; 4 + 8 dim bytes an unknown and, until it returns, 4 bytes a vertex. */
icc_status iccp_unknowns_create(iccp_unknowns *unknowns, const icc_tree *tree, const iccp_env *env);

/* Moves the zeros from the vertices outside onto the boundary itself, where the grid's edges cross
 * it; edges to a vertex outside that cross nothing keep theirs. The grid has a domain. */
icc_status iccp_unknowns_reach_boundary(iccp_unknowns *unknowns, const iccp_env *env);

/* What a neighbour in direction d of unknown k adds to the diagonal of the Laplacian: the slope of
 * a line to the zero where the neighbour is outside. */
static inline double iccp_unknowns_slope(const iccp_unknowns *unknowns, size_t k, int32_t d)
{
    return unknowns->reach == NULL
               ? 1
               : 1 / unknowns->reach[k * (size_t)unknowns->n_neighbours + (size_t)d];
}

void iccp_unknowns_free(iccp_unknowns *unknowns);

#endif
