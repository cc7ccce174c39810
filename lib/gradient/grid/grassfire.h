/* Chooses the maximum: Algorithm 1. */
#ifndef ICCP_GRASSFIRE_H
#define ICCP_GRASSFIRE_H

#include "gradient/grid/lattice.h"

/* See icc_grid_find_maximum(). `rounds` may be NULL. Everything beyond the last vertices of a mask
 * is outside. Returns ICC_ERR_RESOLUTION if no vertex is inside. */
icc_status iccp_grassfire(const icc_grid *grid, uint32_t *vertex, uint32_t *rounds,
                          const iccp_env *env, icc_error *err);

#endif
