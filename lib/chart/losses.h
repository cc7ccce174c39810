/* Tells which points and coordinates of a chart do not lead to each other, and why. */
#ifndef ICCP_LOSSES_H
#define ICCP_LOSSES_H

#include "chart/chart.h"

/* Finds the flags, ICC_LOSS_*, of at most ICCP_CHART_MANY points that iccp_encode_points() has
 * encoded. The flags of points that failed are 0. Fails only with an error that concerns all of
 * them. */
icc_status iccp_encode_losses(const icc_chart *chart, size_t n, const double *points,
                              const iccp_coords *coords, const icc_status *status, int32_t *flags,
                              iccp_path *path);

/* Finds those of coordinates that iccp_decode_points() has decoded. */
icc_status iccp_decode_losses(const icc_chart *chart, size_t n, const iccp_coords *coords,
                              const double *points, const icc_status *status, int32_t *flags,
                              iccp_path *path);

#endif
