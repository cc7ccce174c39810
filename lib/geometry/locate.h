/* Where points lie with respect to a polygon, and their nearest edges. */
#ifndef ICCP_LOCATE_H
#define ICCP_LOCATE_H

#include "base/once.h"
#include "geometry/boxtree.h"
#include "geometry/buckets.h"
#include "geometry/facet_tree.h"
#include "geometry/polygon.h"
#include "icc/icc.h"

/* One tree of boxes, indexed by position in the polygon and by facet number. */
typedef struct iccp_edge_trees {
    iccp_boxtree edges;
    iccp_facet_tree facets; /* a view */
} iccp_edge_trees;

/* Immutable except for the tree and the buckets. The first query that needs them makes them,
 * because they cost more than checking most polygons. */
typedef struct iccp_locator {
    iccp_memory memory;
    iccp_polygon polygon;
    iccp_edge_trees bare_trees; /* without boxes */
    iccp_once trees;
    iccp_buckets bare; /* without cells */
    iccp_once buckets;
} iccp_locator;

/* Makes a locator for a simple polygon. The locator owns the polygon from then on, also on failure;
 * see iccp_buckets_start(). `facets` is a tree of its edges without boxes. Returns NULL if there is
 * no memory. */
iccp_locator *iccp_locator_create(iccp_polygon *polygon, const iccp_facet_tree *facets,
                                  const double *lower, const double *upper, const iccp_band *band,
                                  const iccp_memory *memory);
void iccp_locator_free(iccp_locator *locator, const iccp_memory *memory);

/* Returns the polygon's tree, without boxes if there is no memory for them. Any number of threads
 * may call it at the same time. */
const iccp_edge_trees *iccp_locator_trees(const iccp_locator *locator);

/* Finds where a point lies. Without memory for the buckets it is slower, with the same result. Any
 * number of threads may call it at the same time. With `nearest`, it always sets place->edge and
 * place->t; a point that is not finite then counts as the origin. */
iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest);

#endif
