/* Decides which part of the target is paired with which part of the source. */
#ifndef ICCP_PART_PARTNERS_H
#define ICCP_PART_PARTNERS_H

#include "match/domain_parts.h"

/* ICC_ERR_BOUNDARY unless both domains have equally many parts, holes, lines, points, points with a
 * radius, and regions inside others. */
icc_status iccp_parts_count(const iccp_domain_parts *source, const iccp_domain_parts *target,
                            icc_error *err);

/* Pairs parts of similar place, size and number of holes at the least sum of squares. `partner` has
 * ICCP_NO_FEATURE, or a partner known already. ICC_ERR_AMBIGUOUS if two could exchange partners
 * nearly as well, up to the factor `sure`. ICC_ERR_BOUNDARY if partners have different numbers of
 * features. */
icc_status iccp_parts_partner(uint32_t *partner, const icc_domain *const *domains,
                              const iccp_domain_parts *parts, double sure, const iccp_env *env,
                              icc_error *err);

#endif
