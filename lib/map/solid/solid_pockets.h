/* Repairs the few tetrahedra that a repair has left. The surroundings of each, a pocket, are mapped
 * anew. */
#ifndef ICCP_SOLID_POCKETS_H
#define ICCP_SOLID_POCKETS_H

#include "domain/domain.h"
#include "map/solid/solid_map.h"

/* Finds a mesh of `from`, in its local coordinates, and images in those of `to`, such that all
 * tetrahedra are positive. Both domains are filled. Both results are NULL, with ICC_OK, if none was
 * found. */
typedef icc_status iccp_solid_solve(iccp_simplices **mesh, double **images, const icc_domain *from,
                                    const icc_domain *to, const iccp_env *env);

/* Repairs pockets of a map with a mesh of its own. The mesh may get other points inside. Everything
 * outside the pockets stays. It ends at the first pocket that cannot be repaired. */
icc_status iccp_solid_mend_pockets(iccp_solid_map *map, const icc_domain *source,
                                   iccp_solid_solve *solve, const iccp_env *env);

#endif
