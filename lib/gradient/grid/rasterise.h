/* Makes a grid from a domain. */
#ifndef ICCP_RASTERISE_H
#define ICCP_RASTERISE_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

/* See icc_grid_create(). Two layers of vertices lie beyond the bounding box on every side.
 * Positions are origin + spacing * i, rounded.
 *
 * Polygons and surfaces: along the longest side exactly `cells` vertices lie inside the bounding
 * box, half a cell away from it at both ends. Along the other sides vertices are centred, at least
 * a quarter of a cell away from the box, or in the middle if it is thinner. A vertex is inside if
 * it lies strictly inside the boundary, exactly. In dimensions above 2, only the largest piece of
 * the inside is kept.
 *
 * Masks: every cell is cut into the same even number of parts along each axis. It is the least
 * number that gives `cells` along the longest side, or two if `cells` is 0. A vertex is inside if
 * all cells around it are. So the boundary's vertices are grid vertices, and they are outside. */
icc_status iccp_grid_create(icc_grid **out, const icc_domain *domain, int32_t cells,
                            const iccp_env *env, icc_error *err);

#endif
