/* From an overlay of two domains cut open back to a map of the domains. */
#ifndef ICCP_GLUE_H
#define ICCP_GLUE_H

#include "map/compatible/plmap.h"
#include "map/isotopy/cut_polygon.h"

/* The map whose mesh is the overlay of the two cut polygons, one of which is `polygon`, with the
 * sides of cuts and lines joined. Cuts are forgotten; the vertices of rings, lines and points are
 * fixed. */
icc_status iccp_glue(iccp_plmap *map, const iccp_overlay *overlay, const iccp_cut_polygon *polygon,
                     const iccp_scene *scene, const iccp_env *env);

#endif
