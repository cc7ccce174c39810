/* Chooses the method of a chart, or of the two charts of a map. */
#ifndef ICCP_CHART_CREATE_H
#define ICCP_CHART_CREATE_H

#include "chart/chart.h"

/* See icc_chart_create(). Checks and completes the options. */
icc_status iccp_chart_create(icc_chart **out, const icc_domain *domain,
                             const icc_chart_options *options, const iccp_env *env, icc_error *err);

/* Creates the charts of two domains that correspond (map/map.h), with the same cuts of the
 * boundary and paired maxima. The options differ only in `maximum`. On failure both charts are
 * NULL, and err->side tells which one failed. */
icc_status iccp_chart_create_pair(icc_chart *out[2], const icc_domain *const domain[2],
                                  const icc_chart_options options[2], const iccp_env *env,
                                  icc_error *err);

#endif
