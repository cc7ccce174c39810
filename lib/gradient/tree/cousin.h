/* The tree object and Algorithm 2 in both published forms. */
#ifndef ICCP_COUSIN_H
#define ICCP_COUSIN_H

#include "gradient/grid/lattice.h"

struct icc_tree {
    iccp_memory memory;
    atomic_size_t references;
    icc_grid *grid;
    int32_t form; /* ICC_TREE_* */
    int32_t axis_order[ICC_MAX_DIM];
    uint32_t root;
    uint32_t *parent;    /* ICCP_NONE for the root and for vertices without one */
    int32_t *generation; /* -1: not reached */
    uint32_t *order;     /* the n_reached vertices, parents before children: first the
                            n_inside inside, then those outside, both by generation */
    size_t n_reached;    /* vertices with a generation */
    size_t n_inside;     /* those of them that are inside */
};

/* See icc_tree_create(); the root is inside. `axis_order` may be NULL.
 *
 * Two layers outside get a generation: the neighbours of vertices inside that are reached, and
 * their neighbours. In 2-D a grid cell with one corner inside and reached so has values at all
 * corners, except at those that are inside themselves and not reached. */
icc_status iccp_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root, int32_t form,
                            const int32_t *axis_order, const iccp_env *env, icc_error *err);

/* Takes part in keeping a tree alive, which is logically const for the one who asks. */
icc_tree *iccp_tree_retain(const icc_tree *tree);
void iccp_tree_release(icc_tree *tree);

#endif
