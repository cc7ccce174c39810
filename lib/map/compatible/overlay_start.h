/* A start for mesh maps between any two polygons, which needs no charts. */
#ifndef ICCP_OVERLAY_START_H
#define ICCP_OVERLAY_START_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* What a crossing costs in iccp_work until it is merged with others: a microsecond or two. */
enum { ICCP_CROSSING_COST = 4 };

/* What merging a vertex of an overlay may add to the energy round it. */
#define ICCP_RISE 0.3

/* All triangles are positive before and after the map, exactly, or ICC_ERR_CERTIFICATE;
 * ICC_ERR_RESOLUTION when the overlay would be too large (map/compatible/compatible.h). The work
 * of making the overlay and merging its crossings is counted when it is done, be it more than there
 * is; then steps take what is left, but no more than `most`. `map` is to be freed on failure,
 * too. */
icc_status iccp_overlay_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              double most, iccp_work *work, const iccp_env *env);

/* The second half of that, for an overlay that is one-to-one: fewer triangles, and steps on both
 * sides. Every state is one-to-one, so no path in the source comes to cross what it does not. */
icc_status iccp_overlay_relax(iccp_plmap *map, iccp_work *work, const iccp_env *env);

/* One round of it; `gain`: the share by which the energy has fallen. */
icc_status iccp_overlay_round(iccp_plmap *map, iccp_work *work, double *gain, const iccp_env *env);

#endif
