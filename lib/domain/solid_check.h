/* Checks the surfaces, lines and points of a solid with features. */
#ifndef ICCP_SOLID_CHECK_H
#define ICCP_SOLID_CHECK_H

#include "domain/solid_domain.h"

/* Returns ICC_ERR_BOUNDARY unless facets name existing vertices, none twice, and every vertex of a
 * surface has a facet. `features` has the numbers of vertices and facets. */
icc_status iccp_solid_features_numbers(const iccp_features *features, const iccp_outer *outer,
                                       const icc_feature *given, const iccp_env *env,
                                       icc_error *err);

/* Checks the rest: that surfaces are closed, and that nothing meets, lies outside or in a void. The
 * domain has its given vertices and its facets. Fills in its frame, local vertices, orientation,
 * genus and n_voids, and the orientations, places and sides of its features. Exact. Returns what
 * icc_domain_create_solid() does. */
icc_status iccp_solid_features_check(icc_domain *domain, const iccp_env *env, icc_error *err);

#endif
