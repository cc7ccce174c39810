/* The object icc_match: two domains with common vertices, from two that have none in common. */
#ifndef ICCP_MATCH_H
#define ICCP_MATCH_H

#include "domain/domain.h"

struct icc_match {
    iccp_memory memory;
    icc_domain *domain[2]; /* source and target with common vertices */
    size_t n;
    uint32_t *origin[2];       /* n: vertices of the domains given; UINT32_MAX: added */
    iccp_facet_tree places[2]; /* the domains' facets with those of lines and points; empty for a
                                  domain without lines and points */
    icc_match_info info;
};

/* See icc_match_create(); arguments have been checked but for the domains' dimension and features.
 */
icc_status iccp_match_create(icc_match **out, const icc_domain *source, const icc_domain *target,
                             size_t n_landmarks, const double *landmarks,
                             const icc_match_options *options, const iccp_env *env, icc_error *err);

/* Accepts NULL. */
void iccp_match_release(icc_match *match);

#endif
