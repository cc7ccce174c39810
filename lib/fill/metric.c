/* Makes a metric. The second moments of the points have the Cholesky factorisation C = G G^T. So
 * the points G^-1 x have the unit matrix as their moments. */
#include "fill/metric.h"

#include "base/minmax.h"

#include <math.h>

void iccp_metric_make(iccp_metric *metric, size_t n, const double *points)
{
    /* Share of the squared size below which the points count as flat */
    const double flattest = 0x1p-46;
    double mean[3] = {0}, c[3][3] = {{0}};
    *metric = (iccp_metric){.on = true};
    for (size_t i = 0; i < 3 * n; ++i)
        mean[i % 3] += points[i] / (double)n;
    for (size_t i = 0; i < 3 * n; ++i)
        for (size_t k = 0; k <= i % 3; ++k)
            c[i % 3][k] += (points[i] - mean[i % 3]) * (points[i - i % 3 + k] - mean[k]);
    const double least = flattest * (c[0][0] + c[1][1] + c[2][2]);
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = c[i][j];
            for (int k = 0; k < j; ++k)
                sum -= metric->out[i][k] * metric->out[j][k];
            metric->out[i][j] = i == j ? sqrt(iccp_max(sum, least)) : sum / metric->out[j][j];
        }
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j <= i; ++j) {
            double sum = i == j ? 1.0 : 0.0;
            for (int k = j; k < i; ++k)
                sum -= metric->out[i][k] * metric->in[k][j];
            metric->in[i][j] = sum / metric->out[i][i];
        }
}
