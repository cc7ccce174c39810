/* Checks boundaries in dimension 1 and 3 to 6 that the caller gives, and describes their
 * defects. */
#ifndef ICCP_SIMPLICIAL_H
#define ICCP_SIMPLICIAL_H

#include "domain/complex.h"
#include "geometry/facet_tree.h"
#include "geometry/frame.h"

/* Fits a frame to the vertices that belong to facets of a complex, with dim coordinates each, and
 * writes their local coordinates. Facets may have any number of corners. Vertices without facets
 * get the coordinates of a vertex with facets, so that loops over all vertices meet no other
 * points. Returns ICC_ERR_BOUNDARY if a vertex is not finite, or too near an axis of the local
 * frame for exact computation. */
icc_status iccp_simplicial_localise(iccp_frame *frame, double *local, size_t dim,
                                    const iccp_complex *c, const double *vertices,
                                    const iccp_env *env, icc_error *err);

/* Returns true if the corners of a facet are affinely independent. Exact. */
bool iccp_simplicial_has_area(const iccp_facet_tree *tree, uint32_t facet);

/* Returns ICC_ERR_BOUNDARY if a facet has no area, or if all vertices lie in one hyperplane. */
icc_status iccp_simplicial_check_flat(const iccp_facet_tree *tree, icc_error *err);

/* For dim == 3: returns ICC_ERR_BOUNDARY if the surface meets itself. It must be closed and
 * connected around each vertex. */
icc_status iccp_simplicial_check_simple(const iccp_facet_tree *tree, size_t n_vertices,
                                        const iccp_frame *frame, const iccp_env *env,
                                        icc_error *err);

/* Computes the volume in local units and its sign, the orientation. For surfaces in space the sign
 * may be wrong if the volume is tiny: closed_surfaces.h knows it. In higher dimensions, returns
 * ICC_ERR_BOUNDARY if doubles cannot distinguish the volume from 0. */
icc_status iccp_simplicial_measure(const iccp_facet_tree *tree, int32_t *orientation,
                                   double *volume, icc_error *err);

#endif
