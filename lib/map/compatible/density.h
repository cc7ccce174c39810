/* Cuts the long edges of a plane map's mesh. */
#ifndef ICCP_DENSITY_H
#define ICCP_DENSITY_H

#include "map/compatible/plmap.h"

/* Cuts edges that are longer than `longest` after the map, or before it and stretched. The longest
 * edge of a triangle comes first. The map stays the same. Without slivers it makes at most about
 * 4 (area / longest^2) cuts. */
icc_status iccp_limit_edges(iccp_plmap *map, double longest, const iccp_env *env);

/* Like iccp_limit_edges(), but the bound falls step by step to `longest`, so that the longest edges
 * of all come first. Stops at `enough` triangles. */
icc_status iccp_refine_longest(iccp_plmap *map, double longest, size_t enough, const iccp_env *env);

#endif
