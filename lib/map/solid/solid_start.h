/* Maps of kind mesh in space from two charts. */
#ifndef ICCP_SOLID_START_H
#define ICCP_SOLID_START_H

#include "map/solid/solid_map.h"

/* Fills in mesh, own and images of a map that has none yet: the images of the source's mesh by two
 * charts, repaired until every tetrahedron is positive, which is checked exactly. Where that fails,
 * of the same mesh without chords; then the inverse of what the target's mesh gives likewise; then,
 * where one of the two bodies is star-shaped, without the charts (map/solid/cone_map.h), which is
 * told by `unfolded`; then by the charts again, with points put where tetrahedra stay inverted
 * (map/solid/solid_mend.h). Fills in the members of `info` about the repair: n_unrepaired is 0 if
 * one has led to a map, else the fewest that were left, and the map is none. */
icc_status iccp_solid_start(iccp_solid_map *map, const icc_chart *source, const icc_chart *target,
                            bool *unfolded, icc_map_info *info, const iccp_env *env);

#endif
