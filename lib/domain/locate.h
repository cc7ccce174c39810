/* Where points lie with respect to a polygon, and their nearest edges. */
#ifndef ICCP_LOCATE_H
#define ICCP_LOCATE_H

#include "domain/boxtree.h"
#include "domain/buckets.h"
#include "domain/polygon.h"
#include "icc/icc.h"

/* Immutable once made. */
typedef struct iccp_locator {
    iccp_polygon polygon;
    iccp_boxtree tree;
    iccp_buckets buckets;
} iccp_locator;

/* For a simple polygon, which the locator takes over, also on failure; see iccp_buckets_create().
 * NULL if there is no memory. */
iccp_locator *iccp_locator_create(iccp_polygon *polygon, const double *lower, const double *upper,
                                  const iccp_band *band, const iccp_memory *memory);
void iccp_locator_free(iccp_locator *locator, const iccp_memory *memory);

/* Where a point lies. With `nearest`, place->edge and place->t are set whatever it is; a point that
 * is not finite counts as the origin then. */
iccp_location iccp_locator_find(const iccp_locator *locator, const double *p, bool nearest);

#endif
