/* Height-balanced tree of Adelson-Velsky and Landis, after D. E. Knuth, The Art of Computer
 * Programming 3, section 6.2.3. Nodes keep their height instead of a balance factor. So insertion
 * and removal repair the tree by the same walk to the root. */
#include "geometry/avl.h"

void iccp_avl_create(iccp_avl *tree, uint32_t n, const iccp_memory *memory)
{
    *tree = (iccp_avl){0};
    tree->nodes = iccp_alloc(memory, (size_t)n + 1, sizeof *tree->nodes);
    if (tree->nodes == NULL)
        return;
    tree->nodes[0] = (iccp_avl_node){0};
    for (uint32_t i = 1; i <= n; ++i)
        tree->nodes[i].after = i < n ? i + 1 : 0;
    tree->spare = n > 0 ? 1 : 0;
}

void iccp_avl_free(iccp_avl *tree, const iccp_memory *memory)
{
    iccp_free(memory, tree->nodes);
    *tree = (iccp_avl){0};
}

/* Replaces node `old` by `heir`, or by nothing. */
static void replace(iccp_avl *tree, uint32_t old, uint32_t heir)
{
    iccp_avl_node *const n = tree->nodes;
    const uint32_t parent = n[old].parent;
    if (parent == 0)
        tree->root = heir;
    else if (n[parent].left == old)
        n[parent].left = heir;
    else
        n[parent].right = heir;
    if (heir != 0)
        n[heir].parent = parent;
}

static void update_height(iccp_avl_node *n, uint32_t node)
{
    const int32_t left = n[n[node].left].height, right = n[n[node].right].height;
    n[node].height = 1 + (left > right ? left : right);
}

/* Lifts a child above its parent (a rotation). The subtree between them changes sides. */
static void lift(iccp_avl *tree, uint32_t child)
{
    iccp_avl_node *const n = tree->nodes;
    const uint32_t parent = n[child].parent;
    replace(tree, parent, child);
    uint32_t inner;
    if (n[parent].left == child) {
        inner = n[child].right;
        n[parent].left = inner;
        n[child].right = parent;
    } else {
        inner = n[child].left;
        n[parent].right = inner;
        n[child].left = parent;
    }
    if (inner != 0)
        n[inner].parent = parent;
    n[parent].parent = child;
    update_height(n, parent);
    update_height(n, child);
}

/* Rebalances a node by lifting its higher grandchild. Returns the subtree's new root. */
static uint32_t rebalance(iccp_avl *tree, uint32_t node)
{
    iccp_avl_node *const n = tree->nodes;
    const bool left_heavy = n[n[node].left].height > n[n[node].right].height;
    uint32_t child = left_heavy ? n[node].left : n[node].right;
    const uint32_t inner = left_heavy ? n[child].right : n[child].left;
    const uint32_t outer = left_heavy ? n[child].left : n[child].right;
    if (n[inner].height > n[outer].height) {
        lift(tree, inner);
        child = inner;
    }
    lift(tree, child);
    return child;
}

/* Restores heights and balance from a node upwards, until heights no longer change. */
static void repair(iccp_avl *tree, uint32_t node)
{
    iccp_avl_node *const n = tree->nodes;
    while (node != 0) {
        const int32_t old_height = n[node].height;
        const int32_t tilt = n[n[node].left].height - n[n[node].right].height;
        if (tilt > 1 || tilt < -1)
            node = rebalance(tree, node);
        else
            update_height(n, node);
        if (n[node].height == old_height)
            return;
        node = n[node].parent;
    }
}

uint32_t iccp_avl_insert(iccp_avl *tree, uint32_t before, uint32_t item)
{
    iccp_avl_node *const n = tree->nodes;
    const uint32_t node = tree->spare, after = n[before].after;
    tree->spare = n[node].after;
    n[node] = (iccp_avl_node){.before = before, .after = after, .item = item, .height = 1};
    n[before].after = node;
    n[after].before = node;
    /* Two neighbours in order are ancestor and descendant. The descendant has a free child on the
     * side of the other. */
    if (tree->root == 0) {
        tree->root = node;
    } else if (before != 0 && n[before].right == 0) {
        n[before].right = node;
        n[node].parent = before;
    } else {
        n[after].left = node;
        n[node].parent = after;
    }
    repair(tree, n[node].parent);
    return node;
}

/* Puts the successor of a node with two children into the node's place. The successor has no left
 * child. Returns the lowest node whose subtree has changed. */
static uint32_t replace_by_successor(iccp_avl *tree, uint32_t node)
{
    iccp_avl_node *const n = tree->nodes;
    const uint32_t heir = n[node].after;
    const bool is_child = n[heir].parent == node;
    const uint32_t changed = is_child ? heir : n[heir].parent;
    if (!is_child) {
        replace(tree, heir, n[heir].right);
        n[heir].right = n[node].right;
        n[n[heir].right].parent = heir;
    }
    replace(tree, node, heir);
    n[heir].left = n[node].left;
    n[n[heir].left].parent = heir;
    n[heir].height = n[node].height;
    return changed;
}

void iccp_avl_remove(iccp_avl *tree, uint32_t node)
{
    iccp_avl_node *const n = tree->nodes;
    uint32_t changed = n[node].parent;
    if (n[node].left != 0 && n[node].right != 0)
        changed = replace_by_successor(tree, node);
    else
        replace(tree, node, n[node].left != 0 ? n[node].left : n[node].right);
    n[n[node].before].after = n[node].after;
    n[n[node].after].before = n[node].before;
    n[node].after = tree->spare;
    tree->spare = node;
    repair(tree, changed);
}
