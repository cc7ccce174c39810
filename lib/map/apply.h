/* Applies a map of any kind to many points. */
#ifndef ICCP_APPLY_H
#define ICCP_APPLY_H

#include "map/map.h"

/* See icc_map_apply() and icc_map_apply_inverse(). */
icc_status iccp_map_apply(const icc_map *map, bool inverse, size_t n, const double *points,
                          double *images, icc_status *status, size_t *n_failed,
                          const iccp_env *env);

/* See icc_map_jacobian(). */
icc_status iccp_map_jacobian(const icc_map *map, size_t n, const double *points, double *jacobians,
                             icc_status *status, size_t *n_failed, const iccp_env *env);

#endif
