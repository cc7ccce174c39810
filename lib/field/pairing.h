/* Where a point inside a domain goes when the boundary moves, about: for the maximum of the
 * target's chart. */
#ifndef ICCP_PAIRING_H
#define ICCP_PAIRING_H

#include "domain/domain.h"

/* Local coordinates in `from`, then in `to`, whose facets correspond. Whether the image is inside,
 * and not much closer to the boundary than the point is, by the domains' sizes. O(facets). */
bool iccp_pair_point(const icc_domain *from, const icc_domain *to, const double *point,
                     double *image);

#endif
