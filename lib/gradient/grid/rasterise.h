/* Making a grid from a domain. */
#ifndef ICCP_RASTERISE_H
#define ICCP_RASTERISE_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

/* See icc_grid_create(). Two layers of vertices lie beyond the bounding box on every side.
 * Positions are origin + spacing * i, rounded.
 *
 * Polygons and surfaces: along the longest side there are exactly `cells` vertices inside the
 * bounding box, half a cell away from it at both ends; along the others the vertices are centred,
 * at least a quarter of a cell away from the box (in the middle when it is thinner than that). A
 * vertex is inside when it lies strictly inside the boundary, exactly. Beyond the plane only the
 * largest piece of the inside is kept.
 *
 * Masks: every cell is cut in the same even number of parts along each axis, the least for which
 * there are `cells` along the longest side; 0: two. A vertex is inside when all cells around it
 * are, so that the boundary's vertices are vertices of the grid, and outside. */
icc_status iccp_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                            const iccp_env *env, icc_error *err);

#endif
