/* Compatible triangulations of two simple polygons. */
#ifndef ICCP_COMPATIBLE_H
#define ICCP_COMPATIBLE_H

#include "map/compatible/overlay.h"
#include "map/compatible/plmap.h"

/* Makes the overlay of two polygons with n corners, each triangulated by diagonals.
 * ICC_ERR_BOUNDARY if one of them is not simple and counter-clockwise. ICC_ERR_RESOLUTION as in
 * overlay.h. The caller frees the overlay on failure, too. */
icc_status iccp_compatible_overlay(iccp_overlay *overlay, size_t n, const double *points,
                                   const double *images, const iccp_env *env);

/* Makes a map from the polygon of the boundary vertices of `base`, a mesh of `source`, to the
 * polygon of their images. It has new vertices inside. Every triangle is positive before and after
 * the map, except for rounding. The distortion may be large. ICC_ERR_RESOLUTION if it takes more
 * than 100,000 + 100 n vertices inside. O(n log n + k log k) for n boundary vertices and k vertices
 * inside. */
icc_status iccp_compatible_create(iccp_plmap *map, const iccp_planar *base,
                                  const icc_domain *source, const double *images, double stretch,
                                  const iccp_env *env);

/* Makes a map from the overlay of two polygons of n corners. The corners are fixed, each to the
 * facet of its own number. */
icc_status iccp_plmap_of_overlay(iccp_plmap *map, size_t n, const iccp_overlay *overlay,
                                 double stretch, const iccp_memory *memory);

#endif
