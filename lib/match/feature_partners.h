/* Which feature of the target goes with which of the source. */
#ifndef ICCP_FEATURE_PARTNERS_H
#define ICCP_FEATURE_PARTNERS_H

#include "domain/domain.h"

/* ICC_ERR_BOUNDARY unless both have as many holes, as many lines, as many points and as many with a
 * radius. Either may have no features. */
icc_status iccp_features_count(const icc_domain *source, const icc_domain *target, icc_error *err);

/* Whether feature f of the source and g of the target are of one kind. */
bool iccp_features_may_pair(const icc_domain *source, uint32_t f, const icc_domain *target,
                            uint32_t g);

/* Holes go with holes, lines with lines, points with points and their circles with circles: to
 * those that are nearest on the whole. `moved`: the source's vertices where the target's should be;
 * `partner` has UINT32_MAX, or what is known already. ICC_ERR_AMBIGUOUS where two could as well go
 * to each other's places, up to the factor `sure`. */
icc_status iccp_features_partner(uint32_t *partner, const icc_domain *source,
                                 const icc_domain *target, const double *moved, double sure,
                                 const iccp_env *env, icc_error *err);

#endif
