/* Makes the images of all simplices of a map positive. The mesh stays the same. */
#ifndef ICCP_UNTANGLE_H
#define ICCP_UNTANGLE_H

#include "map/energy/simplicial_map.h"
#include "map/energy/work.h"

/* Moves patches around inverted simplices, then all points, round by round. It may not succeed:
 * *n_left counts the simplices that are not positive in the end. */
icc_status iccp_untangle(const iccp_simplicial_map *map, iccp_work *work, size_t *n_left,
                         const iccp_env *env);

#endif
