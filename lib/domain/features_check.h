/* Checks that features lie in the domain, and that they meet themselves and one another only at
 * common vertices. */
#ifndef ICCP_FEATURES_CHECK_H
#define ICCP_FEATURES_CHECK_H

#include "domain/features.h"

/* Returns "a hole", "a line", "a point" or "a region". A hole in 3-D is "a void". */
const char *iccp_feature_name(int32_t dim, int32_t kind);

/* Room for a text of iccp_feature_text(). */
enum { ICCP_FEATURE_TEXT = 64 };

/* Writes "feature 3 (a line)". For UINT32_MAX returns "the outer ring" or "the outer surface". */
const char *iccp_feature_text(const iccp_features *features, uint32_t feature, char *text);

/* Returns the number of a vertex or facet of the domain in its own feature. */
unsigned long iccp_feature_vertex(const iccp_features *features, uint32_t feature, uint32_t vertex);
unsigned long iccp_feature_facet(const iccp_features *features, uint32_t feature, uint32_t facet);

/* Completes the message of a failure with the feature at fault. `own` describes the failure in the
 * numbers of the feature. Returns the status of `own`. */
icc_status iccp_features_blame(icc_error *err, const icc_error *own, const iccp_features *features,
                               uint32_t feature);

/* Checks the outer ring and the features of a domain, makes its network, and fills in the
 * orientations of rings. The domain's local vertices, frame and features must be there otherwise.
 * Exact. Returns ICC_ERR_BOUNDARY and ICC_ERR_OUTSIDE as icc_domain_create_features() does. */
icc_status iccp_features_check(icc_domain *domain, const iccp_env *env, icc_error *err);

#endif
