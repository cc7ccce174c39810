/* Estimates where a point inside a domain goes when the boundary moves. It places the maximum of
 * the target's chart. Source: moving least squares; see pairing.c. */
#ifndef ICCP_PAIRING_H
#define ICCP_PAIRING_H

#include "domain/domain.h"

/* Maps a point with local coordinates in `from` to local coordinates in `to`, whose facets
 * correspond. Returns true if the image is inside and not much closer to the boundary than the
 * point, relative to the domains' sizes. O(facets). */
bool iccp_pair_point(const icc_domain *from, const icc_domain *to, const double *point,
                     double *image);

#endif
