/* The tree object, and Algorithm 2 in both published forms.
 *
 * Words of this folder, stage 2 of the papers. Begin with this file.
 * - root: the vertex of the maximum, where the tree begins.
 * - generation: the number of steps from the root along the tree.
 * - cousins: vertices whose parents are neighbours. By the cousin rule, neighbours are parent and
 *   child or cousins (verify.h).
 * - form: ICC_TREE_*, which tells whether outside vertices get parents.
 * - rank: the place of a vertex in an order from the highest to the lowest (ranks.h).
 * - grow, thin: to find an order with one critical vertex, by adding vertices from the root or by
 *   removing them from the end (grow.h).
 *
 * Ways: cousin.c grows a tree. grow.h finds an order, by queue.h, and gives up a few
 * vertices if there is none. verify.h and ranks.h check.
 *
 * Invariants: parents come before children in `order`, and inside vertices before outside ones.
 * Only verify.h and ranks.h tell whether the rules hold; a tree that breaks them is still a
 * tree. */
#ifndef ICCP_COUSIN_H
#define ICCP_COUSIN_H

#include "gradient/grid/lattice.h"

#include <stdbool.h>

struct icc_tree {
    iccp_memory memory;
    atomic_size_t references;
    icc_grid *grid;
    int32_t form; /* ICC_TREE_* */
    int32_t axis_order[ICC_MAX_DIM];
    uint32_t root;
    bool is_given;       /* the caller gave the parents inside */
    uint32_t *parent;    /* ICCP_NONE for the root and for vertices without one */
    int32_t *generation; /* -1: not reached */
    /* The n_reached vertices, parents before children: first the n_inside inside, then the outside
     * ones, both by generation */
    uint32_t *order;
    size_t n_reached; /* vertices with a generation */
    size_t n_inside;  /* number of those that are inside */
};

/* See icc_tree_create(). The root is inside. `axis_order` may be NULL.
 *
 * Two layers outside get a generation: the neighbours of inside vertices that are reached, and
 * their neighbours. Consider a 2-D grid cell with an inside corner that is reached. It has values
 * at all corners except inside ones that are not reached. */
icc_status iccp_tree_create(icc_tree **out, const icc_grid *grid, uint32_t root, int32_t form,
                            const int32_t *axis_order, const iccp_env *env, icc_error *err);

/* See icc_tree_create_parents(). Vertices inside get the given parents. */
icc_status iccp_tree_create_parents(icc_tree **out, const icc_grid *grid, uint32_t root,
                                    const uint32_t *parents, int32_t form,
                                    const int32_t *axis_order, const iccp_env *env, icc_error *err);

/* Adds a reference that keeps a tree alive. To its users the tree stays const. */
icc_tree *iccp_tree_retain(const icc_tree *tree);
void iccp_tree_release(icc_tree *tree);

#endif
