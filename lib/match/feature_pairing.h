/* Pairs the holes, lines and points of two domains whose outlines are paired. */
#ifndef ICCP_FEATURE_PAIRING_H
#define ICCP_FEATURE_PAIRING_H

#include "match/outline/matched_domains.h"
#include "match/part_pairing.h"

/* Adds the features of two domains, in the order of the source's, including the outlines of parts.
 * Both domains have equally many features of each kind in each pair of parts. ICC_ERR_AMBIGUOUS,
 * ICC_ERR_ARGUMENT. */
icc_status iccp_pair_features(iccp_matched_domains *matched, iccp_paired_parts *paired,
                              const iccp_sorted_landmarks *landmarks,
                              const icc_match_options *options, const iccp_env *env,
                              icc_error *err);

#endif
