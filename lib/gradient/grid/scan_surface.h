/* Finds the grid vertices inside a closed surface. */
#ifndef ICCP_SCAN_SURFACE_H
#define ICCP_SCAN_SURFACE_H

#include "domain/domain.h"
#include "gradient/grid/lattice.h"

/* Sets `inside` and n_inside of a new grid in the domain's local coordinates, which contains its
 * bounding box. Any dimension. */
icc_status iccp_scan_surface(icc_grid *grid, const icc_domain *domain, const iccp_env *env);

#endif
