/* A start for maps of domains with features. */
#ifndef ICCP_FEATURE_START_H
#define ICCP_FEATURE_START_H

#include "map/compatible/plmap.h"
#include "map/energy/schedule.h"
#include "map/isotopy/cuts.h"

/* What is known of a start. The caller frees it in any case. */
typedef struct iccp_feature_report {
    size_t n_trees;         /* trees of cuts that led to a start */
    iccp_cuts cuts;         /* the cuts of the start */
    iccp_domain_pair scene; /* the two domains */
} iccp_feature_report;

/* Makes a map that is exactly one-to-one and takes each feature of one domain to the feature of the
 * same number in the other, vertex by vertex. With ties, the map has the isotopy class that they
 * describe. Without ties, several trees of cuts are tried, and the map of least energy is taken.
 * work->search limits the trees that lead to a map, work->vain the others, and work->overlay the
 * steps that relax the start.
 *
 * Returns ICC_ERR_RESOLUTION if rounding spoils the start of every tree that was tried, and the
 * errors of iccp_ties_read() for ties. */
icc_status iccp_feature_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              const icc_map_options *options, iccp_allowance *work,
                              iccp_feature_report *report, const iccp_env *env, icc_error *err);

void iccp_feature_report_free(iccp_feature_report *report);

/* Makes the start of the given cuts. Returns ICC_ERR_RESOLUTION if rounding spoils it. */
icc_status iccp_feature_start_from(iccp_plmap *map, const icc_domain *source,
                                   const icc_domain *target, const iccp_cuts *cuts,
                                   iccp_work *relaxing, const iccp_env *env);

#endif
