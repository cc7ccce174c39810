/* Plane sweep over a plane graph: tests whether sides meet only at common nodes, and counts the
 * rings around each side. O(n log n). */
#ifndef ICCP_GRAPH_SWEEP_H
#define ICCP_GRAPH_SWEEP_H

#include "base/env.h"

#include <stdbool.h>

/* A graph whose sides are segments between nodes. A node is a point; no two nodes are equal. Two
 * half-sides belong to side s: 2 s leaves from its first end, 2 s + 1 from its second. */
typedef struct iccp_graph {
    const double *points;
    const uint32_t *ends; /* side s joins points ends[2 s] and ends[2 s + 1] */
    size_t n_ends;        /* number of sides, including numbers that are not used */
    size_t n_nodes;
    const uint32_t *nodes;   /* by x, then y */
    const uint32_t *first;   /* by node v: its half-sides are leaving[first[v]] .. first[v + 1] */
    const uint32_t *leaving; /* counter-clockwise from direction (0, -1), which is excluded */
    const int32_t *gain; /* by side: rings around a place on its left, less those on its right */
} iccp_graph;

#define ICCP_NO_HALF UINT32_MAX

/* Sides a < b that meet elsewhere than at a common node. */
typedef struct iccp_graph_defect {
    int32_t kind; /* ICC_DEFECT_CROSSING, ICC_DEFECT_TOUCH; 0: none */
    uint32_t a, b;
    bool b_is_node; /* instead: node b, which has no sides, lies on side a */
} iccp_graph_defect;

/* Orders the half-sides that leave node v. `work` has room for their number. Returns true if no
 * two have the same direction; else the defect tells which. */
bool iccp_graph_order_node(iccp_graph_defect *found, const iccp_graph *graph, uint32_t v,
                           uint32_t *leaving, uint32_t *work);

/* Looks for sides that meet elsewhere than at a common node. If there are several defects, any of
 * them may be found. Without a defect, left[s] is the number of rings around a place on the left of
 * side s. For a node that no side comes to from the left, below[v] is the half-side just below that
 * has v on its left, or ICCP_NO_HALF. */
icc_status iccp_graph_sweep(iccp_graph_defect *found, const iccp_graph *graph, int32_t *left,
                            uint32_t *below, const iccp_env *env);

#endif
