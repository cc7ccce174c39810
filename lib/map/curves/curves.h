/* Map kind curves: point by point through the two charts. */
#ifndef ICCP_CURVES_H
#define ICCP_CURVES_H

#include "chart/chart.h"

/* From one chart's domain to the other's, in the callers' coordinates. `jacobian`: dim * dim
 * numbers, or NULL. On failure the image is NaN and the jacobian undefined. */
icc_status iccp_curves_point(const icc_chart *from, const icc_chart *to, const double *point,
                             double *image, double *jacobian, iccp_path *path);

/* Logarithms of the shares of the domains' measures that lie around a point and its image, for the
 * same piece of a facet and of the way. Their difference says how much the map shrinks there. Both
 * 0 on the boundary and at the maximum. */
typedef struct iccp_shares {
    double from, to;
} iccp_shares;

/* The same without derivatives for at most ICCP_CHART_MANY points, whose own outcomes are `status`;
 * returned is what concerns all. `shares`: for charts of method field, or NULL; undefined for
 * points that fail. */
icc_status iccp_curves_points(const icc_chart *from, const icc_chart *to, size_t n,
                              const double *points, double *images, iccp_shares *shares,
                              icc_status *status, iccp_path *path);

#endif
