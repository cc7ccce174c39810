/* Meshes that fill a boundary in any dimension. Each of their simplices has a corner inside, so
 * there is always a vertex that can move. */
#ifndef ICCP_FILL_HIGHER_H
#define ICCP_FILL_HIGHER_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* Makes a mesh of the cells of a mask: each cell is the cone from its middle over its faces, which
 * are cut as the boundary is. *out is NULL, with ICC_OK, if there would be too many simplices. */
icc_status iccp_fill_mask(iccp_simplices **out, const icc_domain *domain, const iccp_env *env);

/* Makes the cone over a boundary. Its only inner vertex is the last point, whose place is still to
 * be found. */
icc_status iccp_fill_cone(iccp_simplices **out, const icc_domain *domain, const iccp_env *env);

#endif
