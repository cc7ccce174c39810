/* Which vertices of a grid lie inside a mask. */
#ifndef ICCP_SCAN_MASK_H
#define ICCP_SCAN_MASK_H

#include "domain/mask.h"
#include "grid/lattice.h"

/* Sets `inside` and n_inside of a new grid that has `cuts` vertices to a cell along each axis, the
 * walls between cells among them, and `margin` layers of vertices beyond the mask. A vertex is
 * inside when all cells around it are. */
icc_status iccp_scan_mask(icc_grid *grid, const iccp_mask *mask, size_t cuts, size_t margin,
                          const iccp_env *env);

#endif
