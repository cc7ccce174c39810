/* The facets of the surface become faces of the mesh, and what lies outside goes. */
#ifndef ICCP_FACETS_H
#define ICCP_FACETS_H

#include "fill/surface.h"

/* For a mesh that has the segments: afterwards each facet is made of faces of it. */
icc_status iccp_recover_facets(iccp_tets *m, const iccp_surface *s, const iccp_env *env,
                               icc_error *err);

/* Drops the tetrahedra outside of the surface. Sides on the surface are walls then, with the number
 * of the facet. */
icc_status iccp_carve(iccp_tets *m, const iccp_surface *s, const iccp_env *env, icc_error *err);

#endif
