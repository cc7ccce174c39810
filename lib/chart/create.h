/* Choosing the method of a chart. */
#ifndef ICCP_CHART_CREATE_H
#define ICCP_CHART_CREATE_H

#include "chart/chart.h"

/* See icc_chart_create(); checks and completes the options. */
icc_status iccp_chart_create(icc_chart **out, const icc_domain *domain,
                             const icc_chart_options *options, const iccp_env *env,
                             icc_error *err);

#endif
