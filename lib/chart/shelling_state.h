/* What a chart of method foliation on the caller's mesh knows, and what it can do. */
#ifndef ICCP_SHELLING_STATE_H
#define ICCP_SHELLING_STATE_H

#include "chart/chart.h"
#include "trace/fibre.h"

typedef struct iccp_shelling_state {
    iccp_simplices *mesh; /* the chart's own, where the domain's has no vertex inside; or NULL */
    iccp_fibres fibres;
    double centre[ICC_MAX_DIM]; /* local */
} iccp_shelling_state;

extern const iccp_chart_ops iccp_shelling_ops;

#endif
