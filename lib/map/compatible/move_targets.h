/* Moves the fixed vertices of a plane map to another target. */
#ifndef ICCP_MOVE_TARGETS_H
#define ICCP_MOVE_TARGETS_H

#include "map/compatible/improve_moving.h"

/* Calls iccp_continue() for a plane map. If the way is blocked, iccp_improve_moving() changes the
 * mesh. *room is what that function wants to know after the motion. */
icc_status iccp_move_targets(iccp_plmap *map, const icc_domain *target,
                             const iccp_mesh_limits *limits, size_t patience, iccp_work *work,
                             bool *reached, double *room, const iccp_env *env);

/* Writes where a target wants the image of a fixed vertex. */
void iccp_target_place(const iccp_plmap *map, const icc_domain *target, size_t vertex,
                       double place[2]);

#endif
