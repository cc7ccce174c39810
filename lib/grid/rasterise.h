/* Making a grid from a polygon. */
#ifndef ICCP_RASTERISE_H
#define ICCP_RASTERISE_H

#include "domain/domain.h"
#include "grid/lattice.h"

/* See icc_grid_create(); cells in 2..16384. Along the longest side there are exactly `cells` vertices
 * inside the bounding box, half a cell away from it at both ends; along the other the vertices are
 * centred, at least a quarter of a cell away from the box (in the middle when it is thinner than
 * that). Two layers of vertices lie beyond the bounding box on every side.
 *
 * A vertex is inside when it lies strictly inside the polygon, exactly, for the rounded position
 * origin + spacing * i. */
icc_status iccp_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                            const iccp_env *env, icc_error *err);

#endif
