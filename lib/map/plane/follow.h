/* Mesh maps that follow a target. */
#ifndef ICCP_FOLLOW_H
#define ICCP_FOLLOW_H

#include "map/plane/mesh_map.h"

/* The map to another target from the one to `old_target`; see icc_map_retarget(). Features keep the
 * isotopy class that map->isotopy tells. Otherwise as iccp_mesh_map_create(). */
icc_status iccp_mesh_map_follow(iccp_mesh_map **out, const iccp_mesh_map *map,
                                const icc_domain *source, const icc_domain *old_target,
                                const icc_domain *target, int32_t iterations, icc_map_info *info,
                                const iccp_env *env, icc_error *err);

#endif
