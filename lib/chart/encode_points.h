/* Converts one point, or a few together, between the caller's coordinates and a chart's. */
#ifndef ICCP_ENCODE_POINTS_H
#define ICCP_ENCODE_POINTS_H

#include "chart/chart.h"

/* Encodes one point in the caller's coordinates: checks it, makes it local and encodes it. */
icc_status iccp_encode_point(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet);

/* Decodes one point to the caller's coordinates, or to NaN if that fails. */
icc_status iccp_decode_point(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path);

/* Encodes at most ICCP_CHART_MANY points without derivatives. `status` gets the outcome of each
 * point. The return value is an error that concerns all of them, or ICC_OK. The coordinates of
 * points that fail are undefined. `volume` is that of encode_many in iccp_chart_ops, and NaN on
 * the boundary and at the maximum. It must be NULL if the method has no encode_many. */
icc_status iccp_encode_points(const icc_chart *chart, size_t n, const double *points,
                              iccp_coords *coords, double *volume, icc_status *status,
                              iccp_path *path);

/* Decodes at most ICCP_CHART_MANY points without derivatives, with `status` and `volume` as in
 * iccp_encode_points(). Points whose status is already an error stay failed. Scales the
 * barycentric coordinates to a sum of 1. */
icc_status iccp_decode_points(const icc_chart *chart, size_t n, iccp_coords *coords, double *points,
                              double *volume, icc_status *status, iccp_path *path);

/* Returns true if an outcome concerns one point only, so that the call continues. */
static inline bool iccp_is_point_status(icc_status status)
{
    return status == ICC_OK || status == ICC_ERR_OUTSIDE || status == ICC_ERR_TRACE ||
           status == ICC_ERR_ARGUMENT;
}

#endif
