/* A balanced tree that is also a doubly linked list. It does not know keys: the caller walks down
 * the tree and says after which node a new one goes. */
#ifndef ICCP_AVL_H
#define ICCP_AVL_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct iccp_avl_node {
    uint32_t parent, left, right;
    uint32_t before, after; /* neighbours in order */
    uint32_t item;          /* belongs to the caller */
    int32_t height;         /* 0: no node; 1: a leaf */
} iccp_avl_node;

/* Node 0 means "no node" and closes the list into a circle: nodes[0].after is the first node. */
typedef struct iccp_avl {
    iccp_avl_node *nodes;
    uint32_t root;
    uint32_t spare; /* unused nodes, linked by `after` */
} iccp_avl;

/* Makes an empty tree with room for n nodes. tree->nodes is NULL if there is no memory. */
void iccp_avl_create(iccp_avl *tree, uint32_t n, const iccp_memory *memory);
void iccp_avl_free(iccp_avl *tree, const iccp_memory *memory);

/* Adds a node directly after node `before` (0: at the front) and returns it. O(log n). */
uint32_t iccp_avl_insert(iccp_avl *tree, uint32_t before, uint32_t item);

/* Removes a node. O(log n). */
void iccp_avl_remove(iccp_avl *tree, uint32_t node);

#endif
