/* The two domains of a map between surfaces in space, filled with tetrahedra. */
#ifndef ICCP_FILLED_PAIR_H
#define ICCP_FILLED_PAIR_H

#include "domain/domain.h"

/* Sets *filled to the domain, retained, or to a filled one if it has no mesh. The caller releases
 * it. If the surface cannot be filled, the result is ICC_ERR_RESOLUTION, and `err` names the facet
 * and the side, the source (0) or the target (1). */
icc_status iccp_fill_side(icc_domain **filled, const icc_domain *domain, size_t side,
                          const iccp_env *env, icc_error *err);

/* Replaces each of two domains that has no mesh by a filled one, and retains the other. The caller
 * releases both. If a surface cannot be filled, the result is ICC_ERR_RESOLUTION and `err` names
 * side and facet. */
icc_status iccp_fill_pair(icc_domain *filled[2], const icc_domain *const domains[2],
                          const iccp_env *env, icc_error *err);

#endif
