/* Warps pictures pixel by pixel, by any map. */
#ifndef ICCP_WARP_POINTS_H
#define ICCP_WARP_POINTS_H

#include "map/apply.h"

/* See icc_map_warp(). The pictures have been checked. */
icc_status iccp_warp_points(const icc_map *map, const icc_picture *source,
                            const icc_picture *target, size_t *n_failed, const iccp_env *env);

#endif
