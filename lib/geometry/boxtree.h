/* A tree of bounding boxes over the edges of a polygon. */
#ifndef ICCP_BOXTREE_H
#define ICCP_BOXTREE_H

#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>

enum { ICCP_BOXTREE_LEAF = 4 }; /* edges per leaf */

typedef struct iccp_box {
    double lower[2], upper[2];
} iccp_box;

static inline bool iccp_boxes_meet(const iccp_box *a, const iccp_box *b)
{
    return a->lower[0] <= b->upper[0] && b->lower[0] <= a->upper[0] && a->lower[1] <= b->upper[1] &&
           b->lower[1] <= a->upper[1];
}

/* Returns the bounding box of two points. */
static inline iccp_box iccp_box_of(const double *a, const double *b)
{
    return (iccp_box){{a[0] < b[0] ? a[0] : b[0], a[1] < b[1] ? a[1] : b[1]},
                      {a[0] > b[0] ? a[0] : b[0], a[1] > b[1] ? a[1] : b[1]}};
}

static inline iccp_box iccp_box_hull(iccp_box a, iccp_box b)
{
    for (int k = 0; k < 2; ++k) {
        a.lower[k] = b.lower[k] < a.lower[k] ? b.lower[k] : a.lower[k];
        a.upper[k] = b.upper[k] > a.upper[k] ? b.upper[k] : a.upper[k];
    }
    return a;
}

/* A complete binary tree stored as a heap: node 1 is the root, and node i has children 2 i and 2 i
 * + 1. Leaf n_leaves + j holds edges 4 j to 4 j + 3. Leaves beyond the last edge have empty
 * boxes. */
typedef struct iccp_boxtree {
    const double *points; /* n + 1 points, borrowed; edge k joins points k and k + 1 */
    size_t n;
    size_t n_leaves;
    iccp_box *boxes; /* NULL: queries visit every node */
} iccp_boxtree;

/* Makes the tree. An edge with a NaN coordinate may be in no box. If there is no memory,
 * tree->boxes is NULL; queries then give the same answers, but slowly. */
void iccp_boxtree_create(iccp_boxtree *tree, const double *points, size_t n,
                         const iccp_memory *memory);
iccp_boxtree iccp_boxtree_without_boxes(const double *points, size_t n);
void iccp_boxtree_free(iccp_boxtree *tree, const iccp_memory *memory);

static inline iccp_box iccp_boxtree_edge(const iccp_boxtree *tree, size_t edge)
{
    return iccp_box_of(tree->points + 2 * edge, tree->points + 2 * edge + 2);
}

/* Lists the edges after edge `after` whose boxes meet that of `after`, in ascending order. */
typedef struct iccp_boxtree_query {
    const iccp_boxtree *tree;
    iccp_box box;
    size_t node;
    size_t next, end; /* edges of the current leaf that are still to be visited */
} iccp_boxtree_query;

void iccp_boxtree_start(iccp_boxtree_query *query, const iccp_boxtree *tree, uint32_t after);
bool iccp_boxtree_next(iccp_boxtree_query *query, uint32_t *edge);

/* Returns the edge nearest to p, the first if there are several. Also returns its nearest point, as
 * a share *t of the edge, and the squared distance. For p far away the order value
 * (geometry/away.h) replaces the distance. */
uint32_t iccp_boxtree_nearest(const iccp_boxtree *tree, const double *p, double *t,
                              double *distance2);

/* Returns true if the squared distance of that edge is at most `distance2`. This is faster than
 * finding it. */
bool iccp_boxtree_reaches(const iccp_boxtree *tree, const double *p, double distance2);

#endif
