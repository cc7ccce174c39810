/* A linear map that makes a stretched surface equally wide in all directions. Shapes are measured
 * there. */
#ifndef ICCP_METRIC_H
#define ICCP_METRIC_H

#include <stdbool.h>
#include <stddef.h>

typedef struct iccp_metric {
    bool on;
    double in[3][3], out[3][3]; /* lower triangular matrices, inverse to each other */
} iccp_metric;

/* Makes the metric in which n points, 3 numbers each, have the same spread in all directions. */
void iccp_metric_make(iccp_metric *metric, size_t n, const double *points);

/* d = lower d */
static inline void iccp_metric_apply(const double lower[3][3], double d[3])
{
    d[2] = lower[2][0] * d[0] + lower[2][1] * d[1] + lower[2][2] * d[2];
    d[1] = lower[1][0] * d[0] + lower[1][1] * d[1];
    d[0] = lower[0][0] * d[0];
}

/* Turns the normal of a plane into the direction that leads away from it fastest in the metric. */
static inline void iccp_metric_steepest(const iccp_metric *metric, double normal[3])
{
    const double(*const g)[3] = metric->out;
    normal[0] = g[0][0] * normal[0] + g[1][0] * normal[1] + g[2][0] * normal[2];
    normal[1] = g[1][1] * normal[1] + g[2][1] * normal[2];
    normal[2] = g[2][2] * normal[2];
    iccp_metric_apply(g, normal);
}

#endif
