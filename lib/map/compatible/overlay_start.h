/* Makes a start for mesh maps between any two polygons. It needs no charts. */
#ifndef ICCP_OVERLAY_START_H
#define ICCP_OVERLAY_START_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* The work that a crossing costs until it is merged with others. It takes 1 to 2 microseconds. */
enum { ICCP_CROSSING_COST = 4 };

/* Merging a vertex of an overlay may raise the energy around it by this share. */
#define ICCP_RISE 0.3

/* Makes a map whose triangles are all exactly positive before and after it. ICC_ERR_CERTIFICATE if
 * rounding spoils it, ICC_ERR_RESOLUTION if the overlay would be too large (compatible.h). Making
 * the overlay may exceed the work that is left. Steps then take the rest, but at most `most`. The
 * caller frees `map` on failure, too. */
icc_status iccp_overlay_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              double most, iccp_work *work, const iccp_env *env);

/* Relaxes an overlay that is one-to-one: merges vertices, flips edges and takes steps on both
 * sides. Every state is one-to-one, so the isotopy class stays the same. */
icc_status iccp_overlay_relax(iccp_plmap *map, iccp_work *work, const iccp_env *env);

/* Makes one round. *gain: the share by which the energy has fallen. */
icc_status iccp_overlay_round(iccp_plmap *map, iccp_work *work, double *gain, const iccp_env *env);

#endif
