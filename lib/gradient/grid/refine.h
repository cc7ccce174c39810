/* Makes grids of half the spacing. */
#ifndef ICCP_REFINE_H
#define ICCP_REFINE_H

#include "gradient/grid/lattice.h"

/* See icc_grid_refine(). */
icc_status iccp_grid_refine(icc_grid **out, const icc_grid *grid, const iccp_env *env,
                            icc_error *err);

#endif
