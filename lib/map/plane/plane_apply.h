/* Mesh maps in the plane, applied to points in the caller's coordinates. */
#ifndef ICCP_PLANE_APPLY_H
#define ICCP_PLANE_APPLY_H

#include "map/plane/mesh_map.h"

/* See iccp_map_kind. */
icc_status iccp_plane_apply(const icc_map *map, bool inverse, size_t n, const double *points,
                            double *images, double *jacobians, icc_status *status, iccp_path *path);

#endif
