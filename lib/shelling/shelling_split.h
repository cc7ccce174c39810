/* Adds an inside vertex to a mesh that has none, because the leaves of a foliation need a vertex
 * to end at. */
#ifndef ICCP_SHELLING_SPLIT_H
#define ICCP_SHELLING_SPLIT_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* Makes a copy of the domain's mesh with a point in the middle of one simplex. Of the simplices
 * that this splits into positive ones, it takes the one whose middle is farthest from the
 * boundary. The copy does not have the caller's numbers. Fails with ICC_ERR_RESOLUTION if all
 * simplices are too flat. */
icc_status iccp_split_deepest(iccp_simplices **out, const icc_domain *domain, const iccp_env *env,
                              icc_error *err);

#endif
