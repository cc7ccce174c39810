/* Checking boundaries in dimension 1 and 3 to 6 as the caller gives them, and saying what is
 * wrong. */
#ifndef ICCP_SIMPLICIAL_H
#define ICCP_SIMPLICIAL_H

#include "domain/complex.h"
#include "geometry/facet_tree.h"
#include "geometry/frame.h"

/* Fits a frame to the vertices, of dim coordinates, that belong to facets of a complex (with any
 * number of corners) and writes their local coordinates; the others get those of one that does, so
 * that no loop over all vertices meets anything else. ICC_ERR_BOUNDARY for a vertex that is not
 * finite, or too near an axis of the local frame to work with exactly. */
icc_status iccp_simplicial_localise(iccp_frame *frame, double *local, size_t dim,
                                    const iccp_complex *c, const double *vertices,
                                    const iccp_env *env, icc_error *err);

/* Whether the corners of a facet span it. Exact. */
bool iccp_simplicial_has_area(const iccp_facet_tree *tree, uint32_t facet);

/* ICC_ERR_BOUNDARY for a facet without area, or if all vertices lie in one hyperplane. */
icc_status iccp_simplicial_check_flat(const iccp_facet_tree *tree, icc_error *err);

/* dim == 3: ICC_ERR_BOUNDARY if the surface meets itself, which is closed and connected round each
 * vertex. */
icc_status iccp_simplicial_check_simple(const iccp_facet_tree *tree, size_t n_vertices,
                                        const iccp_frame *frame, const iccp_env *env,
                                        icc_error *err);

/* The orientation, +1 or -1, and the volume in local units. Exact and accurate to rounding for a
 * surface that is simple (dim == 3); beyond, ICC_ERR_BOUNDARY if doubles cannot tell the volume
 * from 0. */
icc_status iccp_simplicial_measure(const iccp_facet_tree *tree, int32_t *orientation,
                                   double *volume, icc_error *err);

#endif
