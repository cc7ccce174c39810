/* Lists the facets whose boxes meet a given box, by the tree of boxes. */
#include "base/minmax.h"
#include "geometry/facet_tree.h"

#include <math.h>

static ICCP_INLINE bool overlap(size_t dim, const double *a, const double *b)
{
    for (size_t k = 0; k < dim; ++k)
        if (!(a[k] <= b[dim + k] && b[k] <= a[dim + k]))
            return false;
    return true;
}

/* Returns true if the segment passes through a box that is wider by `reach`, or within rounding of
 * it. Compares where along the segment it enters and leaves each pair of planes (Ericson, section
 * 5.3.3), with a small margin. */
static bool passes(size_t dim, const double *box, const double *from, const double *to,
                   double reach)
{
    double enter = 0, leave = 1;
    for (size_t k = 0; k < dim; ++k) {
        const double step = to[k] - from[k];
        if (!(fabs(step) > 0))
            continue; /* overlap() has looked already */
        const double low = (box[k] - reach - from[k]) / step;
        const double high = (box[dim + k] + reach - from[k]) / step;
        const double slack = 1e-14 * (1 + fabs(from[k] / step));
        enter = iccp_max(enter, iccp_min(low, high) - slack);
        leave = iccp_min(leave, iccp_max(low, high) + slack);
    }
    return enter <= leave;
}

static ICCP_INLINE bool wanted(const iccp_facet_query *query, size_t dim, const double *box)
{
    return overlap(dim, box, query->box) &&
           (query->from == NULL || passes(dim, box, query->from, query->to, query->reach));
}

/* Returns the next node in left-to-right order that is not below `node`, or 0 at the end. */
static size_t skip(size_t node)
{
    while (node & 1)
        node >>= 1;
    return node == 0 ? 0 : node + 1;
}

static void enter_leaf(iccp_facet_query *query, size_t node)
{
    const size_t first = (node - query->tree->n_leaves) * ICCP_FACET_LEAF;
    query->node = skip(node);
    query->next = first;
    query->end =
        first + ICCP_FACET_LEAF < query->tree->n ? first + ICCP_FACET_LEAF : query->tree->n;
}

/* Goes to the first matching leaf from a node on. */
static ICCP_INLINE bool descend(iccp_facet_query *query, size_t dim, size_t node)
{
    const iccp_facet_tree *tree = query->tree;
    while (node != 0) {
        if (tree->boxes != NULL && !wanted(query, dim, tree->boxes + 2 * dim * node))
            node = skip(node);
        else if (node < tree->n_leaves)
            node = 2 * node;
        else
            break;
    }
    if (node != 0)
        enter_leaf(query, node);
    else
        query->node = 0;
    return node != 0;
}

static ICCP_INLINE bool next_of(iccp_facet_query *query, size_t dim, size_t n_corners,
                                uint32_t *facet)
{
    do {
        while (query->next < query->end) {
            double box[2 * ICC_MAX_DIM];
            *facet = iccp_facet_at(query->tree, query->next++);
            iccp_facet_box_of(query->tree, dim, n_corners, *facet, box);
            if (wanted(query, dim, box))
                return true;
        }
    } while (descend(query, dim, query->node));
    return false;
}

void iccp_facet_query_start(iccp_facet_query *query, const iccp_facet_tree *tree, const double *box)
{
    *query = (iccp_facet_query){.tree = tree, .node = 1};
    for (size_t i = 0; i < 2 * tree->dim; ++i)
        query->box[i] = box[i];
}

void iccp_facet_query_start_after(iccp_facet_query *query, const iccp_facet_tree *tree,
                                  size_t place)
{
    *query = (iccp_facet_query){.tree = tree};
    iccp_facet_box(tree, iccp_facet_at(tree, place), query->box);
    enter_leaf(query, tree->n_leaves + place / ICCP_FACET_LEAF);
    query->next = place + 1;
}

bool iccp_facet_query_next(iccp_facet_query *query, uint32_t *facet)
{
    const size_t dim = query->tree->dim, n_corners = query->tree->n_corners;
    if (dim == 3)
        return n_corners == 3 ? next_of(query, 3, 3, facet) : next_of(query, 3, 4, facet);
    return next_of(query, dim, n_corners, facet);
}
