/* Lets a mesh map in space follow a target that moves. */
#ifndef ICCP_SOLID_FOLLOW_H
#define ICCP_SOLID_FOLLOW_H

#include "map/solid/solid_map.h"

/* Makes the map to a new target from the map to `old_target`; see icc_map_retarget(). Fills in the
 * mesh's members of `info`. If the target is not reached, info->n_unrepaired is not 0 and *out is
 * NULL, with ICC_OK. *vertex is then a surface vertex where the motion is blocked. */
icc_status iccp_solid_map_follow(iccp_solid_map **out, const iccp_solid_map *map,
                                 const icc_domain *source, const icc_domain *old_target,
                                 const icc_domain *target, int32_t iterations, iccp_map_facts *info,
                                 size_t *vertex, const iccp_env *env);

#endif
