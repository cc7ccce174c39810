/* A balanced tree that is at the same time a doubly linked list. It knows nothing of keys: the
 * caller walks down it and says after which node a new one goes. */
#ifndef ICCP_AVL_H
#define ICCP_AVL_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct iccp_avl_node {
    uint32_t parent, left, right;
    uint32_t before, after; /* neighbours in the order of the tree */
    uint32_t item;          /* the caller's */
    int32_t height;         /* 0: no node; 1: a leaf */
} iccp_avl_node;

/* Node 0 stands for no node and closes the list into a circle: nodes[0].after is the first of
 * all. */
typedef struct iccp_avl {
    iccp_avl_node *nodes;
    uint32_t root;
    uint32_t spare; /* unused nodes, linked by `after` */
} iccp_avl;

/* Makes an empty tree with room for n nodes; tree->nodes is NULL if there is no memory. */
void iccp_avl_create(iccp_avl *tree, uint32_t n, const iccp_memory *memory);
void iccp_avl_free(iccp_avl *tree, const iccp_memory *memory);

/* Adds a node just after another one (0: before all) and returns it. O(log n). */
uint32_t iccp_avl_insert(iccp_avl *tree, uint32_t before, uint32_t item);

/* O(log n). */
void iccp_avl_remove(iccp_avl *tree, uint32_t node);

#endif
