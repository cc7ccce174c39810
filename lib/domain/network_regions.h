/* The region in which each face of a network lies. */
#ifndef ICCP_NETWORK_REGIONS_H
#define ICCP_NETWORK_REGIONS_H

#include "domain/network.h"

/* Fills in, for each half-side of a domain with a network, the region on its left: 1 + k for the
 * k-th feature of kind ICC_FEATURE_REGION, or 0. If several regions contain the place, the
 * innermost one counts: the one with the fewest faces within its ring. Returns ICC_OK or
 * ICC_ERR_MEMORY. The time is linear in the sides within each region, added up over all regions. */
icc_status iccp_network_find_regions(uint32_t *region, const icc_domain *domain,
                                     const iccp_memory *memory);

#endif
