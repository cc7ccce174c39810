/* A vertex inside for meshes that have none: the leaves of a foliation need one to end at. */
#ifndef ICCP_SHELLING_SPLIT_H
#define ICCP_SHELLING_SPLIT_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* A copy of the domain's mesh with a point put into one simplex, of those that it splits into
 * positive ones the simplex whose middle is farthest from the boundary. It does not know the
 * caller's numbers. ICC_ERR_RESOLUTION when all are too flat. */
icc_status iccp_split_deepest(iccp_simplices **out, const icc_domain *domain, const iccp_env *env,
                              icc_error *err);

#endif
