/* Decides which feature of the target is paired with which feature of the source. */
#ifndef ICCP_FEATURE_PARTNERS_H
#define ICCP_FEATURE_PARTNERS_H

#include "match/domain_parts.h"

/* Pairs holes with holes, lines with lines, points with points and their circles with circles, such
 * that the pairs are nearest on the whole. Features go with those of the part that is paired with
 * theirs (part_partner). `moved`: the source's vertices where the target's should be. `partner` has
 * UINT32_MAX, or a partner known already. ICC_ERR_AMBIGUOUS if two could exchange partners nearly
 * as well, up to the factor `sure`. */
icc_status iccp_features_partner(uint32_t *partner, const icc_domain *source,
                                 const icc_domain *target, const iccp_domain_parts *parts,
                                 const uint32_t *part_partner, const double *moved, double sure,
                                 const iccp_env *env, icc_error *err);

#endif
