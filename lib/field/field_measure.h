/* Samples which share of the points cannot be encoded, and at which share of the boundary curves
 * leave the domain. For charts of method field. Source: docs/theory/charts-space.md, "fields on
 * grids". */
#ifndef ICCP_FIELD_MEASURE_H
#define ICCP_FIELD_MEASURE_H

#include "chart/chart.h"
#include "field/flow.h"

/* See icc_chart_get_report(). `encode` is the chart's own function. */
icc_status iccp_field_measure(const icc_chart *chart, const iccp_flow *flow, size_t n_points,
                              icc_chart_report *measures, const iccp_env *env);

#endif
