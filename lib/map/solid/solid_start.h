/* Finds a first map of kind mesh in space. */
#ifndef ICCP_SOLID_START_H
#define ICCP_SOLID_START_H

#include "map/solid/solid_map.h"

/* Fills in mesh, own, images and way of an empty map by strategies, one after the other, until
 * every tetrahedron is positive, exactly. Each strategy is tried on the source's mesh and, for the
 * inverse map, on the target's. A target without a mesh is filled when it is needed.
 *
 * Fills in the members of `info` about the repair. n_unrepaired is 0 if a map was found. Otherwise
 * it is the least number left, and there is no map. */
icc_status iccp_solid_start(iccp_solid_map *map, const icc_domain *source, const icc_domain *target,
                            iccp_map_facts *info, const iccp_env *env);

#endif
