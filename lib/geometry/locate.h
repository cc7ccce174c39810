/* Where points lie with respect to a polygon, and their nearest edges. */
#ifndef ICCP_LOCATE_H
#define ICCP_LOCATE_H

#include "base/once.h"
#include "geometry/boxtree.h"
#include "geometry/buckets.h"
#include "geometry/facet_tree.h"
#include "geometry/polygon.h"
#include "icc/icc.h"

/* One tree of boxes by position in the polygon and by the numbers of facets. */
typedef struct iccp_edge_trees {
    iccp_boxtree edges;
    iccp_facet_tree facets; /* a view */
} iccp_edge_trees;

/* Immutable but for the tree and the buckets, which the first that asks for them makes: they cost
 * more than the check of most polygons. */
typedef struct iccp_locator {
    iccp_memory memory;
    iccp_polygon polygon;
    iccp_edge_trees bare_trees; /* no boxes */
    iccp_once trees;
    iccp_buckets bare; /* no cells */
    iccp_once buckets;
} iccp_locator;

/* For a simple polygon, which the locator takes over, also on failure; see iccp_buckets_start().
 * `facets` is a tree of its edges without boxes. NULL if there is no memory. */
iccp_locator *iccp_locator_create(iccp_polygon *polygon, const iccp_facet_tree *facets,
                                  const double *lower, const double *upper, const iccp_band *band,
                                  const iccp_memory *memory);
void iccp_locator_free(iccp_locator *locator, const iccp_memory *memory);

/* The polygon's tree: without boxes where there is no memory for them. Any number of threads may
 * ask at the same time. */
const iccp_edge_trees *iccp_locator_trees(const iccp_locator *locator);

/* Where a point lies: the same, but slower, where there is no memory for the buckets. Any number of
 * threads may ask at the same time. With `nearest`, place->edge and place->t are set whatever it
 * is; a point that is not finite counts as the origin then. */
iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest);

#endif
