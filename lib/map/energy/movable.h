/* Which points of a large map are worth moving. */
#ifndef ICCP_MOVABLE_H
#define ICCP_MOVABLE_H

#include "base/env.h"
#include "map/energy/simplicial_map.h"

/* Whether all points of any map in the plane with so many triangles are to be moved. */
bool iccp_all_are_movable(size_t n_triangles);

/* Sets *movable to an array of the map's points for iccp_newton_create(), which the caller frees,
 * or to NULL where all of them are to be moved: in small maps and in space. All simplices of the
 * map are positive. Left where they are: points whose triangles are so small that together these
 * carry next to nothing of the symmetric Dirichlet energy. */
icc_status iccp_movable_create(uint8_t **movable, const iccp_simplicial_map *map,
                               const iccp_env *env);

#endif
