/* Checks that the features of two solids lie in the same regions. */
#ifndef ICCP_NESTING_SAME_H
#define ICCP_NESTING_SAME_H

#include "domain/features.h"

/* The two solids have corresponding features. A map takes each region to the region of the same
 * number, so everything inside must lie in the same region of both. Returns ICC_ERR_TOPOLOGY if
 * something does not. The message names it, both regions and a remedy. Exact, since the places of
 * features are. Time is linear. */
icc_status iccp_nesting_same(const icc_domain *source, const icc_domain *target, icc_error *err);

#endif
