/* Map kind curves: point by point through the two charts. */
#ifndef ICCP_CURVES_H
#define ICCP_CURVES_H

#include "chart/chart.h"

/* From one chart's domain to the other's, in the callers' coordinates. `jacobian`: dim * dim numbers, or
 * NULL. On failure the image is NaN and the jacobian undefined. */
icc_status iccp_curves_point(const icc_chart *from, const icc_chart *to, const double *point,
                             double *image, double *jacobian, iccp_path *path);

/* The same without derivatives for at most ICCP_CHART_MANY points, whose own outcomes are `status`; returned is
 * what concerns all. */
icc_status iccp_curves_points(const icc_chart *from, const icc_chart *to, size_t n,
                              const double *points, double *images, icc_status *status,
                              iccp_path *path);

#endif
