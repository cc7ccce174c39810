/* The object icc_match: two domains with common vertices, made from two domains that have none in
 * common.
 *
 * Words of this folder
 * - common vertices: vertices that correspond one by one; a match adds those that each domain
 *   lacks.
 * - origin: the given vertex that a common vertex comes from.
 * - feature: a hole, a line or a point inside a plane domain. partner: the feature paired with it.
 * - landmark: a pair of points that the caller knows to correspond.
 * - body: a surface in space and its drawing on the sphere.
 *
 * Invariants
 * - The two domains of a match have the same number of vertices and the same facets.
 * - Given vertices keep their coordinates bit by bit.
 *
 * Ways
 * - In the plane: outline/ pairs the rings, feature_pairing.h then pairs the features.
 *   feature_partners.h (assignment.h) says which, by the places that mean_value.h predicts.
 *   feature_landmarks.h shares out the landmarks.
 * - In space: surfaces.h, by sphere_pair.h and common_mesh/. The words are in surface/half_edges.h.
 * - Points from one domain to the other: match_apply.h. Bytes: match_file.h.
 *
 * Begin with match.c. */
#ifndef ICCP_MATCH_H
#define ICCP_MATCH_H

#include "domain/domain.h"

struct icc_match {
    iccp_memory memory;
    icc_domain *domain[2]; /* source and target, with common vertices */
    size_t n;
    uint32_t *origin[2];       /* n: vertices of the given domains; UINT32_MAX if added */
    iccp_facet_tree places[2]; /* the facets of each domain with those of its lines and points;
                                  empty for a domain without lines and points */
    icc_match_info info;
};

/* See icc_match_create(). Arguments have been checked, except the domains' dimension and
 * features. */
icc_status iccp_match_create(icc_match **out, const icc_domain *source, const icc_domain *target,
                             size_t n_landmarks, const double *landmarks,
                             const icc_match_options *options, const iccp_env *env, icc_error *err);

/* Accepts NULL. */
void iccp_match_release(icc_match *match);

#endif
