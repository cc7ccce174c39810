/* Flipping edges of a one-to-one piecewise linear map for a lower energy. */
#ifndef ICCP_FLIPS_H
#define ICCP_FLIPS_H

#include "map/compatible/plmap.h"

/* Flips inner edges where that lowers the symmetric Dirichlet energy, in a few passes. All
 * triangles are positive before and after the map, which they stay, exactly; no new edge joins two
 * fixed vertices. `n_flips`: how many were flipped. O(n). */
icc_status iccp_flip_edges(iccp_plmap *map, size_t *n_flips, const iccp_env *env);

#endif
