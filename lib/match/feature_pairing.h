/* Pairs the holes, lines and points of two domains whose outer rings are paired. */
#ifndef ICCP_FEATURE_PAIRING_H
#define ICCP_FEATURE_PAIRING_H

#include "match/feature_landmarks.h"
#include "match/outline/matched_domains.h"

/* Adds the features of two domains, in the order of the source's. Their outer rings have the
 * `common` vertices, and both domains have equally many features of each kind. ICC_ERR_AMBIGUOUS,
 * ICC_ERR_ARGUMENT. */
icc_status iccp_pair_features(iccp_matched_domains *matched, const iccp_outline *outer,
                              const iccp_union_outline *common,
                              const iccp_parted_landmarks *landmarks,
                              const icc_match_options *options, const iccp_env *env,
                              icc_error *err);

#endif
