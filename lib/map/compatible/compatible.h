/* A start for mesh maps that is one-to-one for any two polygons. */
#ifndef ICCP_COMPATIBLE_H
#define ICCP_COMPATIBLE_H

#include "map/compatible/overlay.h"
#include "map/compatible/plmap.h"

/* The overlay of triangulations by diagonals of two polygons with n corners. ICC_ERR_BOUNDARY when
 * one of them is not simple and counter-clockwise; ICC_ERR_RESOLUTION as in
 * map/compatible/overlay.h. The overlay is to be freed on failure, too. */
icc_status iccp_compatible_overlay(iccp_overlay *overlay, size_t n, const double *points,
                                   const double *images, const iccp_env *env);

/* Maps the polygon of the boundary vertices of `base`, a mesh of `source`, to that of their images:
 * a triangulation of the one and of the other with the same connectivity, the same corners and
 * points inside of its own. Every triangle is positive before and after, but for rounding, which is
 * left to the repair. ICC_ERR_RESOLUTION when it would take more than 100,000 + 100 n points
 * inside. No regard is paid to fairness. O(n log n + k log k) for n boundary vertices and k points
 * inside. */
icc_status iccp_compatible_create(iccp_plmap *map, const iccp_planar *base,
                                  const icc_domain *source, const double *images, double stretch,
                                  const iccp_env *env);

#endif
