/* Changes the mesh of a plane map while its fixed vertices move, so that they can go on. */
#ifndef ICCP_IMPROVE_MOVING_H
#define ICCP_IMPROVE_MOVING_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Limits on the mesh of a moving map. */
typedef struct iccp_mesh_limits {
    double longest_edge;   /* no merge makes a longer edge, and much shorter edges are not cut */
    size_t most_triangles; /* vertices merge if there are more triangles than this */
} iccp_mesh_limits;

/* Changes the mesh near triangles that have far more energy than others: cuts and flips edges, and
 * moves points and images. Elsewhere it merges vertices if there are too many. `room` tells how
 * many motions like the last one fit in before a triangle flips. If that is enough, nothing is
 * done, unless a triangle has an extreme energy. All triangles stay exactly positive before and
 * after the map. O(n) plus steps near such triangles. */
icc_status iccp_improve_moving(iccp_plmap *map, const iccp_mesh_limits *limits, double room,
                               iccp_work *work, const iccp_env *env);

#endif
