/* Making all image tetrahedra of a piecewise linear map positive. */
#ifndef ICCP_TET_REPAIR_H
#define ICCP_TET_REPAIR_H

#include "domain/simplices.h"

/* Whether a tetrahedron of a mesh is positive with its points at other places, exactly. */
bool iccp_tet_is_positive(const iccp_simplices *mesh, const double *points, size_t simplex);

/* Moves the images, 3 coordinates each, of inner points of the mesh until the images of all simplices are
 * positive, as far as that goes; n_left says how many are not. Deterministic. */
icc_status iccp_tet_repair(const iccp_simplices *mesh, double *images, size_t *n_left,
                           const iccp_env *env);

#endif
