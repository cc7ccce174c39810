/* Warps pictures by a map. */
#ifndef ICCP_WARP_H
#define ICCP_WARP_H

#include "map/apply.h"

/* See icc_map_warp(). The pictures have been checked. */
icc_status iccp_map_warp(const icc_map *map, const icc_picture *source, const icc_picture *target,
                         size_t *n_failed, const iccp_env *env);

#endif
