/* What a map between surfaces in space is made on: both filled with tetrahedra. */
#ifndef ICCP_FILLED_PAIR_H
#define ICCP_FILLED_PAIR_H

#include "domain/domain.h"

/* Replaces each of two domains that has no mesh by one that has, for the caller to release, and
 * retains the other. What cannot be filled: ICC_ERR_RESOLUTION, and `err` names side and facet. */
icc_status iccp_fill_pair(icc_domain *filled[2], const icc_domain *const domains[2],
                          const iccp_env *env, icc_error *err);

#endif
