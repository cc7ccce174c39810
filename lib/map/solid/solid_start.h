/* Finds a first map of kind mesh in space from two charts. */
#ifndef ICCP_SOLID_START_H
#define ICCP_SOLID_START_H

#include "map/solid/solid_map.h"

/* Fills in mesh, own and images of an empty map by strategies, one after the other, until every
 * tetrahedron is positive, exactly. Each strategy is tried on the source's mesh and, for the
 * inverse map, on the target's:
 * - the images by two charts, repaired, also without chords;
 * - pockets, and the way by a ball;
 * - without the charts, onto a star-shaped solid (map/solid/cone_map.h), which sets `unfolded`;
 * - by the charts again, with points added where tetrahedra stay inverted (map/solid/solid_mend.h).
 *
 * Fills in the members of `info` about the repair. n_unrepaired is 0 if a map was found. Otherwise
 * it is the least number left, and there is no map. */
icc_status iccp_solid_start(iccp_solid_map *map, const icc_chart *source, const icc_chart *target,
                            bool *unfolded, iccp_map_facts *info, const iccp_env *env);

#endif
