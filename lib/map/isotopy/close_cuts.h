/* Turns overlays of cut polygons back into a map between the two domains. */
#ifndef ICCP_CLOSE_CUTS_H
#define ICCP_CLOSE_CUTS_H

#include "map/compatible/plmap.h"
#include "map/isotopy/cut_polygon.h"

/* Makes the map whose mesh consists of the overlays of all pairs of polygons. `polygons` are those
 * of one side. The two sides of each cut and of each wall are joined. The map does not remember the
 * cuts. The nodes of the network become fixed. */
icc_status iccp_close_cuts(iccp_plmap *map, const iccp_overlay *overlays,
                           const iccp_cut_polygons *polygons, const iccp_domain_pair *domains,
                           const iccp_env *env);

#endif
