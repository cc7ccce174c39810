/* Nearest facet by branch and bound over a tree of boxes, the nearer child first: N. Roussopoulos,
 * S. Kelley, F. Vincent, Nearest Neighbor Queries, 1995. */
#include "geometry/facet_tree.h"

#include "geometry/simplex.h"

#include <math.h>

enum { LEAF = ICCP_FACET_LEAF };

static ICCP_INLINE double box_distance2(size_t dim, const double *box, const double *p)
{
    double sum = 0;
    for (size_t k = 0; k < dim; ++k) {
        const double below = box[k] - p[k], above = p[k] - box[dim + k];
        const double d = below > above ? below : above;
        sum += d > 0 ? d * d : 0;
    }
    return sum;
}

static ICCP_INLINE double distance2_of(size_t dim, const double *box, const iccp_viewpoint *from)
{
    return from->away != NULL ? iccp_away_bound(from->away, dim, box, box + dim)
                              : box_distance2(dim, box, from->p);
}

static ICCP_INLINE double node_distance2(const iccp_facet_tree *tree, size_t dim, size_t node,
                                         const iccp_viewpoint *from)
{
    return tree->boxes != NULL ? distance2_of(dim, tree->boxes + 2 * dim * node, from) : -HUGE_VAL;
}

typedef struct nearest {
    uint32_t facet;
    double distance2;
    double *bary;
} nearest;

/* Compares the facets of a leaf with the best so far. At equal distance the smaller number wins, so
 * the result does not depend on the order of the tree. With a constant dim the compiler unrolls the
 * loops over coordinates. */
static ICCP_INLINE void search_leaf(const iccp_facet_tree *tree, size_t dim, size_t node,
                                    const iccp_viewpoint *from, nearest *best)
{
    const size_t first = (node - tree->n_leaves) * LEAF;
    for (size_t place = first; place < first + LEAF && place < tree->n; ++place) {
        const uint32_t facet = iccp_facet_at(tree, place);
        const double *corners[ICC_MAX_DIM];
        double box[2 * ICC_MAX_DIM], bary[ICC_MAX_DIM];
        iccp_facet_box_of(tree, dim, dim, facet, box);
        if (distance2_of(dim, box, from) > best->distance2)
            continue;
        iccp_facet_corners(tree, facet, corners);
        const double distance2 =
            from->away != NULL ? iccp_simplex_nearest_from(dim, dim, corners, from->away, bary)
                               : iccp_simplex_nearest(dim, dim, corners, from->p, bary);
        if (distance2 > best->distance2 || (distance2 == best->distance2 && facet > best->facet))
            continue;
        best->facet = facet;
        best->distance2 = distance2;
        for (size_t i = 0; i < dim; ++i)
            best->bary[i] = bary[i];
    }
}

/* Goes down to the leaf on the nearer side of every node, and puts the farther child with its
 * distance on the stack. A child that comes back from the stack is dropped if it is now farther
 * than the best facet. The stack never holds more than one node per level. */
static ICCP_INLINE void search(const iccp_facet_tree *tree, size_t dim, const iccp_viewpoint *from,
                               nearest *best)
{
    struct {
        size_t node;
        double distance2;
    } stack[ICCP_FACET_LEVELS];
    size_t depth = 0, node = 1;
    for (;;) {
        while (node < tree->n_leaves) {
            const double left = node_distance2(tree, dim, 2 * node, from);
            const double right = node_distance2(tree, dim, 2 * node + 1, from);
            const size_t far = right < left ? 2 * node : 2 * node + 1;
            stack[depth].node = far;
            stack[depth++].distance2 = right < left ? left : right;
            node = far ^ 1;
        }
        search_leaf(tree, dim, node, from, best);
        do {
            if (depth == 0)
                return;
            --depth;
        } while (stack[depth].distance2 > best->distance2);
        node = stack[depth].node;
    }
}

uint32_t iccp_facet_tree_nearest(const iccp_facet_tree *tree, const double *p, double *bary,
                                 double *distance2)
{
    nearest best = {UINT32_MAX, HUGE_VAL, bary};
    const iccp_viewpoint here = {p, NULL};
    if (tree->dim == 3)
        search(tree, 3, &here, &best);
    else
        search(tree, tree->dim, &here, &best);
    *distance2 = best.distance2;
    return best.facet;
}

uint32_t iccp_facet_tree_nearest_local(const iccp_facet_tree *tree, const double *p, double *bary)
{
    double distance2;
    if (!iccp_away_is_far(tree->dim, p))
        return iccp_facet_tree_nearest(tree, p, bary, &distance2);
    nearest best = {UINT32_MAX, HUGE_VAL, bary};
    const iccp_away away = iccp_away_from(tree->dim, p);
    search(tree, tree->dim, &(iccp_viewpoint){p, &away}, &best);
    return best.facet;
}
