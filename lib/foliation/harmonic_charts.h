/* Charts of methods foliation and disc, for one domain or for two that correspond. Source:
 * docs/theory/charts-plane.md. */
#ifndef ICCP_HARMONIC_CHARTS_H
#define ICCP_HARMONIC_CHARTS_H

#include "chart/chart.h"

/* See iccp_chart_ops. options->method selects one of the two methods. */
icc_status iccp_harmonic_charts_create(size_t n, icc_chart **out, const icc_domain *const *domain,
                                       const icc_chart_options *options, const iccp_env *env,
                                       icc_error *err);

#endif
