/* A bound on the edges of the mesh of a piecewise linear map. */
#ifndef ICCP_DENSITY_H
#define ICCP_DENSITY_H

#include "map/compatible/plmap.h"

/* Cuts edges that are longer than `longest` after the map, or before it and stretched, each
 * triangle's longest first; the map stays what it is. At most some 4 (area / longest^2) cuts for
 * meshes without slivers. */
icc_status iccp_limit_edges(iccp_plmap *map, double longest, const iccp_env *env);

/* The same with bounds that fall to `longest`, until there are `enough` triangles: the longest
 * edges are cut first. */
icc_status iccp_refine_longest(iccp_plmap *map, double longest, size_t enough, const iccp_env *env);

#endif
