/* Makes domains from conforming meshes. */
#ifndef ICCP_MESH_DOMAIN_H
#define ICCP_MESH_DOMAIN_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* Reads a caller's mesh of any shape into local coordinates of its own. Returns ICC_ERR_BOUNDARY
 * unless all simplices have volume, and each facet belongs to one simplex or to two on opposite
 * sides. `facets` are those of the boundary, or NULL. */
icc_status iccp_mesh_read(iccp_simplices **out, iccp_frame *frame, size_t dim, size_t n_vertices,
                          const double *vertices, size_t n_simplices, const uint32_t *simplices,
                          size_t n_facets, const uint32_t *facets, const iccp_env *env,
                          icc_error *err);

/* See icc_domain_create_mesh(). The caller has checked arguments for NULL, the range of dim and of
 * the counts. */
icc_status iccp_domain_create_mesh(icc_domain **out, const icc_mesh *mesh, size_t n_facets,
                                   const uint32_t *facets, const iccp_env *env, icc_error *err);

#endif
