/* Where points lie with respect to a polygon, and their nearest edges. */
#ifndef ICCP_LOCATE_H
#define ICCP_LOCATE_H

#include "domain/boxtree.h"
#include "domain/buckets.h"
#include "domain/polygon.h"
#include "icc/icc.h"

#include <stdatomic.h>

/* Immutable but for the buckets, which the first point that is asked for makes: they cost more than
 * the check of most polygons. */
typedef struct iccp_locator {
    iccp_memory memory;
    iccp_polygon polygon;
    iccp_boxtree tree;
    iccp_buckets bare;               /* no cells */
    _Atomic(iccp_buckets *) buckets; /* NULL: not yet */
} iccp_locator;

/* For a simple polygon and its tree, which the locator takes over, also on failure; see
 * iccp_buckets_start(). NULL if there is no memory. */
iccp_locator *iccp_locator_create(iccp_polygon *polygon, iccp_boxtree *tree, const double *lower,
                                  const double *upper, const iccp_band *band,
                                  const iccp_memory *memory);
void iccp_locator_free(iccp_locator *locator, const iccp_memory *memory);

/* Where a point lies: the same, but slower, where there is no memory for the buckets. Any number of
 * threads may ask at the same time. With `nearest`, place->edge and place->t are set whatever it
 * is; a point that is not finite counts as the origin then. */
iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest);

#endif
