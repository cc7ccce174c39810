/* Moves a one-to-one plane map towards a model. */
#ifndef ICCP_APPROACH_H
#define ICCP_APPROACH_H

#include "map/energy/simplicial_map.h"

#include <stdbool.h>

/* Lowers the distance from map->model plus a small share of the symmetric Dirichlet energy. The
 * points with movable[v] != 0 move, unless they are fixed. All triangles of the map must be
 * positive, and stay so. `is_far`: the map may be far from the model. Adds to *n_iterations. Ends
 * early if rounding leaves no step. */
icc_status iccp_approach(const iccp_simplicial_map *map, const uint8_t *movable, bool is_far,
                         size_t *n_iterations, const iccp_env *env);

#endif
