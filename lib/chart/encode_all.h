/* Converts any number of points between the caller's coordinates and a chart's. */
#ifndef ICCP_ENCODE_ALL_H
#define ICCP_ENCODE_ALL_H

#include "chart/chart.h"

/* See icc_chart_encode_flags() and icc_chart_decode_flags(). */
icc_status iccp_encode_all(const icc_chart *chart, size_t n, const double *points, uint32_t *facet,
                           double *bary, double *t, icc_status *status, int32_t *flags,
                           size_t *n_failed, const iccp_env *env);
icc_status iccp_decode_all(const icc_chart *chart, size_t n, const uint32_t *facet,
                           const double *bary, const double *t, double *points, icc_status *status,
                           int32_t *flags, size_t *n_failed, const iccp_env *env);

#endif
