/* Decides which feature of the target is paired with which feature of the source. */
#ifndef ICCP_FEATURE_PARTNERS_H
#define ICCP_FEATURE_PARTNERS_H

#include "domain/domain.h"

/* ICC_ERR_BOUNDARY unless both domains have equally many holes, lines, points, and points with a
 * radius. Either may have no features. */
icc_status iccp_features_count(const icc_domain *source, const icc_domain *target, icc_error *err);

/* Returns true if feature f of the source and feature g of the target are of one kind. */
bool iccp_features_may_pair(const icc_domain *source, uint32_t f, const icc_domain *target,
                            uint32_t g);

/* Pairs holes with holes, lines with lines, points with points and their circles with circles, such
 * that the pairs are nearest on the whole. `moved`: the source's vertices where the target's should
 * be. `partner` has UINT32_MAX, or a partner known already. ICC_ERR_AMBIGUOUS if two could exchange
 * partners nearly as well, up to the factor `sure`. */
icc_status iccp_features_partner(uint32_t *partner, const icc_domain *source,
                                 const icc_domain *target, const double *moved, double sure,
                                 const iccp_env *env, icc_error *err);

#endif
