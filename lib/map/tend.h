/* Keeping the mesh of a map fit while what it holds fixed moves. */
#ifndef ICCP_TEND_H
#define ICCP_TEND_H

#include "map/plmap.h"
#include "map/work.h"

/* Where triangles carry far more energy than an isometry's, edges are cut and flipped, and points
 * and images both go where they have more room; elsewhere vertices merge, as long as no edge gets
 * longer than `longest`. All triangles are positive before and after the map, which they stay,
 * exactly. `changed`: whether the mesh is another. */
icc_status iccp_tend(iccp_plmap *map, double longest, iccp_work *work, bool *changed,
                     const iccp_env *env);

#endif
