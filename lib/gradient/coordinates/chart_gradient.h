/* Method gradient: Integral Curve Coordinates as published. */
#ifndef ICCP_CHART_GRADIENT_H
#define ICCP_CHART_GRADIENT_H

#include "chart/chart.h"

extern const iccp_chart_ops iccp_gradient_ops;

#endif
