/* Making a map in space positive where moving the images of its mesh is not enough. */
#ifndef ICCP_SOLID_MEND_H
#define ICCP_SOLID_MEND_H

#include "domain/domain.h"
#include "map/solid/solid_map.h"

/* For a map with a mesh of its own, positive before the map, which fills `source`, all of whose
 * points have images. Moves images until every tetrahedron is positive after the map, too, and cuts
 * the edges inside of those that stay inverted, round by round, as long as they are few, there are
 * no more than twice as many tetrahedra as at first, and 240 steps on as many of these have not
 * been taken. The surface stays as it is; the mesh is checked, exactly. `n_left`: how many
 * tetrahedra are not positive in the end. On failure the map is to be freed. */
icc_status iccp_solid_mend(iccp_solid_map *map, const icc_domain *source, size_t *n_left,
                           const iccp_env *env);

#endif
