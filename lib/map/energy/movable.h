/* Chooses the points of a large map that are worth moving. */
#ifndef ICCP_MOVABLE_H
#define ICCP_MOVABLE_H

#include "base/env.h"
#include "map/energy/simplicial_map.h"

/* Returns true if all points of a plane map with this many triangles are to be moved. */
bool iccp_all_are_movable(size_t n_triangles);

/* Sets *movable to an array for iccp_newton_create(), with an entry for each point of the map. The
 * caller frees it. *movable is NULL if all points are to be moved, as in small maps and in space.
 * Points stay if all their triangles are tiny and together carry next to nothing of the symmetric
 * Dirichlet energy. All simplices of the map must be positive. */
icc_status iccp_movable_create(uint8_t **movable, const iccp_simplicial_map *map,
                               const iccp_env *env);

#endif
