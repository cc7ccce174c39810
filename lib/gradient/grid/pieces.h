/* Pieces of the inside of a grid. */
#ifndef ICCP_PIECES_H
#define ICCP_PIECES_H

#include "gradient/grid/lattice.h"

/* Keeps the largest set of vertices inside that are joined by steps along the axes, of several the
 * one with the smallest index, and takes the others outside: n_stray of them. ICC_ERR_MEMORY or
 * ICC_ERR_CANCELLED leave the grid as it was. */
icc_status iccp_grid_keep_largest(icc_grid *grid, const iccp_env *env);

#endif
