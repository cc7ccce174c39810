/* Whether features lie inside a polygon and meet neither themselves nor one another. */
#ifndef ICCP_FEATURES_CHECK_H
#define ICCP_FEATURES_CHECK_H

#include "domain/features.h"

/* "a hole", "a line", "a point" */
const char *iccp_feature_name(int32_t kind);

/* Says of a failure, of which `own` tells in the numbers of the feature, whose fault it is. Returns
 * the status of `own`. */
icc_status iccp_features_blame(icc_error *err, const icc_error *own, size_t feature, int32_t kind);

/* Checks the outer ring and the features of a domain whose local vertices, frame and features are
 * there but for the orientations, and fills these in. Exact. ICC_ERR_BOUNDARY and ICC_ERR_OUTSIDE
 * as in icc_domain_create_features(). */
icc_status iccp_features_check(icc_domain *domain, const iccp_env *env, icc_error *err);

#endif
