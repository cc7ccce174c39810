/* Makes a map in space positive if moving the images of its mesh is not enough. */
#ifndef ICCP_SOLID_MEND_H
#define ICCP_SOLID_MEND_H

#include "domain/domain.h"
#include "map/solid/solid_map.h"

/* Moves images until every tetrahedron is positive after the map, too. Round by round, it cuts
 * inner edges of tetrahedra that stay inverted. The map needs a mesh of its own that is positive,
 * fills `source`, and has images of all points.
 *
 * It ends if too many tetrahedra are inverted, if their number has doubled, or after the cost of
 * 240 steps on the first mesh. The surface does not change, and the mesh is checked, exactly.
 * `n_left` counts the tetrahedra that are not positive at the end. On failure, free the map. */
icc_status iccp_solid_mend(iccp_solid_map *map, const icc_domain *source, size_t *n_left,
                           const iccp_env *env);

#endif
