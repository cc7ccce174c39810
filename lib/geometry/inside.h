/* Where points lie with respect to a boundary in any dimension. */
#ifndef ICCP_INSIDE_H
#define ICCP_INSIDE_H

#include "geometry/band.h"
#include "geometry/facet_tree.h"

/* Returns ICC_INSIDE, ICC_BOUNDARY or ICC_OUTSIDE for a point in reach. For ICC_BOUNDARY, it also
 * returns the nearest facet and the barycentric coordinates of its nearest point. */
int32_t iccp_inside_find(const iccp_facet_tree *tree, const iccp_band *band, const double *p,
                         uint32_t *facet, double *bary);

#endif
