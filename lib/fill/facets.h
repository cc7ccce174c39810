/* Recovers the facets of the surface as faces of the mesh, and removes the outside. */
#ifndef ICCP_FACETS_H
#define ICCP_FACETS_H

#include "fill/surface.h"

/* Changes a mesh that contains the segments so that each facet is made of faces of the mesh. */
icc_status iccp_recover_facets(iccp_tets *m, const iccp_surface *s, const iccp_env *env,
                               icc_error *err);

/* Removes the tetrahedra outside the surface. Sides on the surface become walls with the number of
 * the facet. */
icc_status iccp_carve(iccp_tets *m, const iccp_surface *s, const iccp_env *env, icc_error *err);

#endif
