/* Making every triangle of a piecewise linear map in the plane positive, with changes of its
 * mesh. */
#ifndef ICCP_REPAIR_H
#define ICCP_REPAIR_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Flips edges, untangles patches, draws them anew where few triangles are left, and untangles
 * everything; where that is not enough, refines the mesh round what is left and begins again. Gives
 * up early where many triangles are inverted, still after `trial_work` (HUGE_VAL: or after a first
 * round), and when there is no work left. The boundary's images stay; vertices may be numbered
 * anew, in the same order. `n_left` says how many triangles are not positive in the end: 0 unless
 * it failed. */
icc_status iccp_repair(iccp_plmap *map, double trial_work, iccp_work *work, size_t *n_left,
                       const iccp_env *env);

#endif
