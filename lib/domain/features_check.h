/* Checks that features lie inside a polygon, and that they meet neither themselves nor one
 * another. */
#ifndef ICCP_FEATURES_CHECK_H
#define ICCP_FEATURES_CHECK_H

#include "domain/features.h"

/* Returns "a hole", "a line" or "a point". */
const char *iccp_feature_name(int32_t kind);

/* Completes the message of a failure with the feature at fault. `own` describes the failure in the
 * numbers of the feature. Returns the status of `own`. */
icc_status iccp_features_blame(icc_error *err, const icc_error *own, size_t feature, int32_t kind);

/* Checks the outer ring and the features of a domain, and fills in their orientations. The domain's
 * local vertices, frame and features must be there otherwise. Exact. Returns ICC_ERR_BOUNDARY and
 * ICC_ERR_OUTSIDE as icc_domain_create_features() does. */
icc_status iccp_features_check(icc_domain *domain, const iccp_env *env, icc_error *err);

#endif
