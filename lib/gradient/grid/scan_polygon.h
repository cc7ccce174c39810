/* Which vertices of a grid lie inside a polygon. */
#ifndef ICCP_SCAN_POLYGON_H
#define ICCP_SCAN_POLYGON_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

/* Sets `inside` and n_inside of a new grid in the polygon's local coordinates, whose bounding box
 * it contains. A vertex is inside when it lies strictly inside the polygon, exactly, for the
 * rounded position origin + spacing * i. */
icc_status iccp_scan_polygon(icc_grid *grid, const icc_domain *polygon, const iccp_env *env);

#endif
