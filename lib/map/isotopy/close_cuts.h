/* Turns an overlay of two cut polygons back into a map between the two domains. */
#ifndef ICCP_CLOSE_CUTS_H
#define ICCP_CLOSE_CUTS_H

#include "map/compatible/plmap.h"
#include "map/isotopy/cut_polygon.h"

/* Makes the map whose mesh is the overlay of the two cut polygons. `polygon` is one of these two.
 * The two sides of each cut and of each line are joined. The map does not remember the cuts. The
 * vertices of rings, lines and points become fixed. */
icc_status iccp_close_cuts(iccp_plmap *map, const iccp_overlay *overlay,
                           const iccp_cut_polygon *polygon, const iccp_domain_pair *domains,
                           const iccp_env *env);

#endif
