/* Few tetrahedra that a repair has left: what is round each, a pocket, is put in place anew. */
#ifndef ICCP_SOLID_POCKETS_H
#define ICCP_SOLID_POCKETS_H

#include "domain/domain.h"
#include "map/solid/solid_map.h"

/* A mesh of the one, local there, with images local in the other, all of it positive; both NULL,
 * with ICC_OK, where none was found. Both are filled. */
typedef icc_status iccp_solid_solve(iccp_simplices **mesh, double **images, const icc_domain *from,
                                    const icc_domain *to, const iccp_env *env);

/* Of a map with a mesh of its own, whose inside may get other points. What is not in a pocket stays
 * as it is. It ends with the first one that is in vain. */
icc_status iccp_solid_mend_pockets(iccp_solid_map *map, const icc_domain *source,
                                   iccp_solid_solve *solve, const iccp_env *env);

#endif
