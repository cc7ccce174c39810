/* Flips edges of a one-to-one plane map for a lower energy. */
#ifndef ICCP_FLIPS_H
#define ICCP_FLIPS_H

#include "map/compatible/plmap.h"

/* Flips inner edges where that lowers the symmetric Dirichlet energy, in a few passes. All
 * triangles stay exactly positive before and after the map. No new edge joins two fixed vertices.
 * *n_flips counts the flips. O(n). */
icc_status iccp_flip_edges(iccp_plmap *map, size_t *n_flips, const iccp_env *env);

#endif
