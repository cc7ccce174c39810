/* A start for maps of domains with features. */
#ifndef ICCP_FEATURE_START_H
#define ICCP_FEATURE_START_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"
#include "map/isotopy/cuts.h"

/* What is known of a start. The caller frees it in any case. */
typedef struct iccp_feature_report {
    size_t n_trees;         /* of cuts that led to a start */
    iccp_cuts cuts;         /* those that it was made with */
    iccp_domain_pair scene; /* of both domains */
} iccp_feature_report;

/* A map that takes every feature of one domain to the same of the other, vertex by vertex, and is
 * one-to-one, exactly. With ties, their images can be moved to what they say without crossing a
 * feature; else it is the fairest of those that several trees of cuts lead to, before improvement.
 * `trees`, `relaxing`: what finding trees and making the start fair may take.
 *
 * ICC_ERR_RESOLUTION when rounding is in the way of all trees; for ties as iccp_ties_read(). */
icc_status iccp_feature_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              const icc_map_options *options, iccp_work *trees, iccp_work *relaxing,
                              iccp_feature_report *report, const iccp_env *env, icc_error *err);

void iccp_feature_report_free(iccp_feature_report *report);

/* The start that cuts lead to, which the caller has. ICC_ERR_RESOLUTION when rounding is in the
 * way. */
icc_status iccp_feature_start_from(iccp_plmap *map, const icc_domain *source,
                                   const icc_domain *target, const iccp_cuts *cuts,
                                   iccp_work *relaxing, const iccp_env *env);

#endif
