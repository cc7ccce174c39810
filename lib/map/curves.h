/* Map kind curves: point by point through the two charts. */
#ifndef ICCP_CURVES_H
#define ICCP_CURVES_H

#include "map/map.h"

/* From one chart to another, in bulk; see icc_map_apply(). */
icc_status iccp_curves_apply(const icc_chart *from, const icc_chart *to, size_t n,
                             const double *points, double *images, icc_status *status,
                             size_t *n_failed, const iccp_env *env);

/* See icc_map_jacobian(). */
icc_status iccp_curves_jacobian(const icc_chart *from, const icc_chart *to, size_t n,
                                const double *points, double *jacobians, icc_status *status,
                                size_t *n_failed, const iccp_env *env);

#endif
