/* A start for mesh maps between any two polygons, which needs no charts. */
#ifndef ICCP_OVERLAY_START_H
#define ICCP_OVERLAY_START_H

#include "map/plmap.h"
#include "map/work.h"

/* All triangles are positive before and after the map, exactly, or ICC_ERR_CERTIFICATE;
 * ICC_ERR_RESOLUTION when the overlay would be too large (map/compatible.h). Ends when there is no
 * work left for a step. `map` is to be freed on failure, too. */
icc_status iccp_overlay_start(iccp_plmap *map, const icc_domain *source, const icc_domain *target,
                              iccp_work *work, const iccp_env *env);

#endif
