/* Moves a mesh map in the plane to a target that has moved. */
#ifndef ICCP_PLANE_RETARGET_H
#define ICCP_PLANE_RETARGET_H

#include "map/plane/mesh_map.h"

/* Makes the map to `target` from the map to `old_target`. Features keep the class that map->isotopy
 * tells. If the way is blocked for a cage, *out is NULL, with ICC_OK, and info->n_unrepaired is not
 * 0. See icc_map_retarget(). */
icc_status iccp_mesh_map_retarget(iccp_mesh_map **out, const iccp_mesh_map *map,
                                  const icc_domain *source, const icc_domain *old_target,
                                  const icc_domain *target, int32_t iterations,
                                  iccp_map_facts *info, const iccp_env *env, icc_error *err);

#endif
