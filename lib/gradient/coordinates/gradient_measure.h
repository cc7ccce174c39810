/* Estimates what gradient coordinates miss, from evenly spread points. */
#ifndef ICCP_GRADIENT_MEASURE_H
#define ICCP_GRADIENT_MEASURE_H

#include "chart/chart.h"
#include "gradient/coordinates/gradient_state.h"

/* See iccp_chart_ops::measure. */
icc_status iccp_gradient_measure(const icc_chart *chart, size_t n_points,
                                 icc_chart_report *measures, const iccp_env *env);

#endif
