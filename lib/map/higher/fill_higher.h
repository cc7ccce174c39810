/* Meshes that fill a boundary in any dimension. Each of their simplices has a corner inside, so
 * there is always a vertex that can move. */
#ifndef ICCP_FILL_HIGHER_H
#define ICCP_FILL_HIGHER_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* Makes a mesh of the cells of a mask: each cell is the cone from its middle over its faces, which
 * are cut as the boundary is. *out is NULL, with ICC_OK, if there would be too many simplices. */
icc_status iccp_fill_mask(iccp_simplices **out, const icc_domain *domain, const iccp_env *env);

/* Makes the cone over a boundary with collars: each facet and its copy in the next layer bound a
 * prism of simplices, and the apex is joined to the last layer. The inner vertices are the layers,
 * each in the order of the boundary, then the apex. Their places are still to be found. */
icc_status iccp_fill_cone(iccp_simplices **out, const icc_domain *domain, size_t n_collars,
                          const iccp_env *env);

#endif
