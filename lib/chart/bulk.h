/* Bulk conversions between the caller's coordinates and a chart's. */
#ifndef ICCP_BULK_H
#define ICCP_BULK_H

#include "chart/chart.h"

/* One point in the caller's coordinates: checked, made local, encoded. */
icc_status iccp_encode_point(const icc_chart *chart, const double *point, iccp_coords *coords,
                             iccp_encode_jet *jet);

/* One point's coordinates decoded, in the caller's coordinates; NaN when it fails. */
icc_status iccp_decode_point(const icc_chart *chart, const iccp_coords *coords, double *point,
                             iccp_decode_jet *jet, iccp_path *path);

/* The same without derivatives for at most ICCP_CHART_MANY points, whose own outcomes are `status`;
 * returned is what concerns all. Coordinates of points that fail are undefined. `volume`: as
 * iccp_chart_ops has it, where the method has encode_many, and NaN on the boundary and at the
 * maximum; else NULL. */
icc_status iccp_encode_points(const icc_chart *chart, size_t n, const double *points,
                              iccp_coords *coords, double *volume, icc_status *status,
                              iccp_path *path);

/* Points whose status is not ICC_OK already fail. Scales the barycentric coordinates to a sum of
 * 1. */
icc_status iccp_decode_points(const icc_chart *chart, size_t n, iccp_coords *coords, double *points,
                              double *volume, icc_status *status, iccp_path *path);

/* Whether an outcome concerns one point only, so that the call goes on. */
static inline bool iccp_is_point_status(icc_status status)
{
    return status == ICC_OK || status == ICC_ERR_OUTSIDE || status == ICC_ERR_TRACE ||
           status == ICC_ERR_ARGUMENT;
}

/* See icc_chart_encode() and icc_chart_decode(). */
icc_status iccp_encode_all(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                           double *bary, double *t, icc_status *status, size_t *n_failed,
                           const iccp_env *env);
icc_status iccp_decode_all(const icc_chart *chart, size_t n, const uint32_t *facet,
                           const double *bary, const double *t, double *points, icc_status *status,
                           size_t *n_failed, const iccp_env *env);

#endif
