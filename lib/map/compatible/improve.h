/* Lowers the energy of a plane map that is one-to-one, without losing its certificate. */
#ifndef ICCP_IMPROVE_H
#define ICCP_IMPROVE_H

#include "map/compatible/plmap.h"
#include "map/energy/refinement.h"

/* Improves as iccp_improve_by() says. `energy` is the map's at first. A refinement cuts the
 * triangles with the most energy and flips edges. If the map has junctions, vertices that are not
 * worth their triangles merge in the end. The energy may then rise by 1 %, but not above what it
 * was at first. */
icc_status iccp_improve(iccp_plmap *map, double energy, const iccp_schedule *schedule,
                        iccp_work *work, iccp_improvement *improvement, const iccp_env *env);

/* Cuts the triangles that carry most of the energy above an isometry's. The map stays the same. */
icc_status iccp_refine(iccp_plmap *map, size_t *n_cut, const iccp_env *env);

#endif
