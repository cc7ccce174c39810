/* Moves the fixed vertices of a plane map to another target, and changes the mesh so that they can
 * go on. */
#ifndef ICCP_MOVE_TARGETS_H
#define ICCP_MOVE_TARGETS_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Limits on the mesh of a moving map. */
typedef struct iccp_mesh_limits {
    double longest_edge;   /* no merge makes a longer edge, and much shorter edges are not cut */
    size_t most_triangles; /* vertices merge if the whole map has more triangles than this */
    size_t n_elsewhere;    /* triangles of the whole map outside the part that moves */
} iccp_mesh_limits;

/* Changes the mesh near triangles that have far more energy than others: cuts and flips edges, and
 * moves points and images. Elsewhere it merges vertices if there are too many. `room` tells how
 * many motions like the last one fit in before a triangle flips. If that is enough, nothing is
 * done, unless a triangle has an extreme energy. All triangles stay exactly positive before and
 * after the map. O(n) plus steps near such triangles. */
icc_status iccp_improve_moving(iccp_plmap *map, const iccp_mesh_limits *limits, double room,
                               iccp_work *work, const iccp_env *env);

/* Calls iccp_continue() for a plane map. Fixed vertices that keep their places from `old_target` to
 * `target` stay where they are, unless `old_target` is NULL. If the way is blocked,
 * iccp_improve_moving() changes the mesh. *room is what that function wants to know after the
 * motion. */
icc_status iccp_move_targets(iccp_plmap *map, const icc_domain *old_target,
                             const icc_domain *target, const iccp_mesh_limits *limits,
                             size_t patience, iccp_work *work, bool *reached, double *room,
                             const iccp_env *env);

/* Writes where a target wants the image of a fixed vertex. */
void iccp_target_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                       double place[2]);

#endif
