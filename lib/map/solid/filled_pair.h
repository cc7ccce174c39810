/* The two domains of a map between surfaces in space, both filled with tetrahedra. */
#ifndef ICCP_FILLED_PAIR_H
#define ICCP_FILLED_PAIR_H

#include "domain/domain.h"

/* Replaces each of two domains that has no mesh by a filled one, and retains the other. The caller
 * releases both. If a surface cannot be filled, the result is ICC_ERR_RESOLUTION and `err` names
 * side and facet. */
icc_status iccp_fill_pair(icc_domain *filled[2], const icc_domain *const domains[2],
                          const iccp_env *env, icc_error *err);

#endif
