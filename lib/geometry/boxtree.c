/* Strip tree in the manner of D. H. Ballard, Strip trees: a hierarchical representation for curves,
 * 1981, with boxes for strips. The tree halves the polygon, not the plane. Consecutive edges lie
 * close together, so no sorting is needed. */
#include "geometry/boxtree.h"

#include "base/compiler.h"
#include "geometry/away.h"
#include "geometry/segment.h"

#include <math.h>

enum {
    LEAF = ICCP_BOXTREE_LEAF,
    DEEP = 64 /* longer than any path */
};

static const iccp_box empty = {{HUGE_VAL, HUGE_VAL}, {-HUGE_VAL, -HUGE_VAL}};

static size_t leaf_end(const iccp_boxtree *tree, size_t node)
{
    const size_t end = (node - tree->n_leaves + 1) * LEAF;
    return end < tree->n ? end : tree->n;
}

static iccp_box leaf_box(const iccp_boxtree *tree, size_t leaf)
{
    iccp_box box = empty;
    const size_t end = leaf_end(tree, tree->n_leaves + leaf);
    for (size_t edge = leaf * LEAF; edge < end; ++edge)
        box = iccp_box_hull(box, iccp_boxtree_edge(tree, edge));
    return box;
}

iccp_boxtree iccp_boxtree_without_boxes(const double *points, size_t n)
{
    iccp_boxtree tree = {.points = points, .n = n, .n_leaves = 1};
    while (tree.n_leaves * LEAF < n)
        tree.n_leaves *= 2;
    return tree;
}

void iccp_boxtree_create(iccp_boxtree *tree, const double *points, size_t n,
                         const iccp_memory *memory)
{
    *tree = iccp_boxtree_without_boxes(points, n);
    tree->boxes = iccp_alloc(memory, 2 * tree->n_leaves, sizeof *tree->boxes);
    if (tree->boxes == NULL)
        return;
    tree->boxes[0] = empty;
    for (size_t leaf = 0; leaf < tree->n_leaves; ++leaf)
        tree->boxes[tree->n_leaves + leaf] = leaf_box(tree, leaf);
    for (size_t node = tree->n_leaves; node-- > 1;)
        tree->boxes[node] = iccp_box_hull(tree->boxes[2 * node], tree->boxes[2 * node + 1]);
}

void iccp_boxtree_free(iccp_boxtree *tree, const iccp_memory *memory)
{
    iccp_free(memory, tree->boxes);
    *tree = (iccp_boxtree){0};
}

void iccp_boxtree_start(iccp_boxtree_query *query, const iccp_boxtree *tree, uint32_t after)
{
    const size_t first = (size_t)after + 1;
    *query =
        (iccp_boxtree_query){.tree = tree, .box = iccp_boxtree_edge(tree, after), .next = first};
    query->node = tree->n_leaves + after / LEAF;
    query->end = leaf_end(tree, query->node);
}

/* Returns the next node in left-to-right order that is not below `node`, or 0 at the end. */
static size_t skip(size_t node)
{
    while (node & 1)
        node >>= 1;
    return node == 0 ? 0 : node + 1;
}

static bool next_leaf(iccp_boxtree_query *query)
{
    const iccp_boxtree *tree = query->tree;
    size_t node = skip(query->node);
    while (node != 0) {
        if (tree->boxes != NULL && !iccp_boxes_meet(&tree->boxes[node], &query->box))
            node = skip(node);
        else if (node < tree->n_leaves)
            node = 2 * node;
        else
            break;
    }
    query->node = node;
    if (node == 0)
        return false;
    query->next = (node - tree->n_leaves) * LEAF;
    query->end = leaf_end(tree, node);
    return true;
}

bool iccp_boxtree_next(iccp_boxtree_query *query, uint32_t *edge)
{
    do {
        while (query->next < query->end) {
            const size_t e = query->next++;
            const iccp_box box = iccp_boxtree_edge(query->tree, e);
            if (iccp_boxes_meet(&box, &query->box)) {
                *edge = (uint32_t)e;
                return true;
            }
        }
    } while (next_leaf(query));
    return false;
}

static ICCP_INLINE double box_distance2(const iccp_box *box, const double *p)
{
    double sum = 0;
    for (int k = 0; k < 2; ++k) {
        const double below = box->lower[k] - p[k], above = p[k] - box->upper[k];
        const double d = below > above ? below : above;
        sum += d > 0 ? d * d : 0;
    }
    return sum;
}

static ICCP_INLINE double node_distance2(const iccp_boxtree *tree, size_t node,
                                         const iccp_viewpoint *from)
{
    if (tree->boxes == NULL)
        return -HUGE_VAL;
    const iccp_box *box = &tree->boxes[node];
    return from->away != NULL ? iccp_away_bound(from->away, 2, box->lower, box->upper)
                              : box_distance2(box, from->p);
}

typedef struct nearest {
    uint32_t edge;
    double t, distance2;
} nearest;

/* Returns the order value of the point at share t between a and b. */
static double value_at(const iccp_away *away, const double *a, const double *b, double t)
{
    const double q[2] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])};
    return iccp_away_value(away, 2, t < 1 ? q : b);
}

static ICCP_INLINE void search_leaf(const iccp_boxtree *tree, size_t node,
                                    const iccp_viewpoint *from, nearest *best)
{
    const size_t end = leaf_end(tree, node);
    for (size_t e = (node - tree->n_leaves) * LEAF; e < end; ++e) {
        const double *a = tree->points + 2 * e;
        double t, distance2 = iccp_segment_nearest(a, a + 2, from->p, &t);
        if (from->away != NULL)
            distance2 = value_at(from->away, a, a + 2, t);
        if (distance2 < best->distance2 || (distance2 == best->distance2 && e < best->edge))
            *best = (nearest){(uint32_t)e, t, distance2};
    }
}

/* With a constant from->away the compiler drops what is for the other kind of point. */
static ICCP_INLINE nearest search(const iccp_boxtree *tree, const iccp_viewpoint *from)
{
    struct {
        size_t node;
        double distance2;
    } stack[DEEP];
    nearest best = {UINT32_MAX, 0, HUGE_VAL};
    size_t depth = 0, node = 1;
    for (;;) {
        while (node < tree->n_leaves) {
            const double left = node_distance2(tree, 2 * node, from);
            const double right = node_distance2(tree, 2 * node + 1, from);
            const size_t far = right < left ? 2 * node : 2 * node + 1;
            stack[depth].node = far;
            stack[depth++].distance2 = right < left ? left : right;
            node = far ^ 1;
        }
        search_leaf(tree, node, from, &best);
        do {
            if (depth == 0)
                return best;
            --depth;
        } while (stack[depth].distance2 > best.distance2);
        node = stack[depth].node;
    }
}

static nearest search_from_afar(const iccp_boxtree *tree, const double *p)
{
    const iccp_away away = iccp_away_from(2, p);
    return search(tree, &(iccp_viewpoint){p, &away});
}

uint32_t iccp_boxtree_nearest(const iccp_boxtree *tree, const double *p, double *t,
                              double *distance2)
{
    const nearest best = iccp_away_is_far(2, p) ? search_from_afar(tree, p)
                                                : search(tree, &(iccp_viewpoint){p, NULL});
    *t = best.t;
    *distance2 = best.distance2;
    return best.edge;
}

bool iccp_boxtree_reaches(const iccp_boxtree *tree, const double *p, double distance2)
{
    const iccp_viewpoint from = {p, NULL};
    for (size_t node = 1; node != 0;) {
        const bool is_near = node_distance2(tree, node, &from) <= distance2;
        if (is_near && node < tree->n_leaves) {
            node = 2 * node;
            continue;
        }
        nearest best = {UINT32_MAX, 0, HUGE_VAL};
        if (is_near)
            search_leaf(tree, node, &from, &best);
        if (best.distance2 <= distance2)
            return true;
        node = skip(node);
    }
    return false;
}
