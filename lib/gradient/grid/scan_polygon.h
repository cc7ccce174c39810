/* Finds the grid vertices inside a polygon. */
#ifndef ICCP_SCAN_POLYGON_H
#define ICCP_SCAN_POLYGON_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

/* Sets `inside` and n_inside of a new grid in the polygon's local coordinates, which contains its
 * bounding box. A vertex is inside if it lies strictly inside the polygon. That is exact for the
 * rounded position origin + spacing * i. */
icc_status iccp_scan_polygon(icc_grid *grid, const icc_domain *polygon, const iccp_env *env);

#endif
