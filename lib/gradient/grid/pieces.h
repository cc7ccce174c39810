/* Connected pieces of the inside of a grid. */
#ifndef ICCP_PIECES_H
#define ICCP_PIECES_H

#include "gradient/grid/lattice.h"

/* Keeps the largest set of inside vertices that are connected by steps along the axes. If there are
 * several, keeps the one with the smallest index. The others become outside, and n_stray counts
 * them. ICC_ERR_MEMORY and ICC_ERR_CANCELLED leave the grid unchanged. */
icc_status iccp_grid_keep_largest(icc_grid *grid, const iccp_env *env);

#endif
