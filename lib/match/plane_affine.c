/* Fits an affine map by least squares. */
#include "match/plane_affine.h"

#include <string.h>

/* Places whose spread across is less than this share of that along count as lying on a line. Any
 * small number would do: an affine map across a line is a guess, a similarity is not. Places whose
 * spread is less than this share of the size count as one place, such as the centres of a lake and
 * of an island in it. */
static const double flat = 0.01;

void iccp_plane_affine_add(iccp_plane_affine_sums *sums, double weight, const double *from,
                           const double *to)
{
    if (sums->n++ == 0) {
        memcpy(sums->origin, from, 2 * sizeof *from);
        memcpy(sums->origin + 2, to, 2 * sizeof *to);
    }
    const double p[2] = {from[0] - sums->origin[0], from[1] - sums->origin[1]};
    const double q[2] = {to[0] - sums->origin[2], to[1] - sums->origin[3]};
    sums->weight += weight;
    for (int k = 0; k < 2; ++k) {
        sums->sum[k] += weight * p[k];
        sums->sum[2 + k] += weight * q[k];
    }
    sums->from[0] += weight * p[0] * p[0];
    sums->from[1] += weight * p[0] * p[1];
    sums->from[2] += weight * p[1] * p[1];
    sums->to += weight * (q[0] * q[0] + q[1] * q[1]);
    for (int k = 0; k < 4; ++k)
        sums->mixed[k] += weight * q[k / 2] * p[k % 2];
}

/* Moves the first place, if there is one, and scales as the sizes say. */
static void fit_sizes(iccp_plane_affine *affine, const iccp_plane_affine_sums *sums,
                      const double *size)
{
    const double scale = size[0] > 0 ? size[1] / size[0] : 1;
    memcpy(affine->from, sums->origin, sizeof affine->from);
    memcpy(affine->to, sums->origin + 2, sizeof affine->to);
    affine->matrix[0] = affine->matrix[3] = scale;
    affine->matrix[1] = affine->matrix[2] = 0;
}

/* Returns true if places with this weighted sum of squared distances from their mean are spread
 * out. */
static bool is_spread(double sum, double weight, double size)
{
    return sum > weight * flat * size * flat * size;
}

bool iccp_plane_affine_fit(iccp_plane_affine *affine, const iccp_plane_affine_sums *sums,
                           const double *size)
{
    fit_sizes(affine, sums, size);
    if (sums->n == 0)
        return false;
    double mean[4], m[4] = {0}, c[4];
    for (int k = 0; k < 4; ++k)
        mean[k] = sums->sum[k] / sums->weight;
    const double s[3] = {sums->from[0] - sums->sum[0] * mean[0],
                         sums->from[1] - sums->sum[0] * mean[1],
                         sums->from[2] - sums->sum[1] * mean[1]};
    const double spread = sums->to - sums->sum[2] * mean[2] - sums->sum[3] * mean[3];
    for (int k = 0; k < 4; ++k)
        c[k] = sums->mixed[k] - sums->sum[2 + k / 2] * mean[k % 2];
    const double trace = s[0] + s[2], det = s[0] * s[2] - s[1] * s[1];
    if (!is_spread(trace, sums->weight, size[0]) || !is_spread(spread, sums->weight, size[1]))
        return false;
    for (int k = 0; k < 2 && det > flat * flat * trace * trace; ++k) {
        m[2 * k] = (c[2 * k] * s[2] - c[2 * k + 1] * s[1]) / det;
        m[2 * k + 1] = (c[2 * k + 1] * s[0] - c[2 * k] * s[1]) / det;
    }
    if (m[0] * m[3] <= m[1] * m[2]) {
        m[0] = m[3] = (c[0] + c[3]) / trace;
        m[2] = (c[2] - c[1]) / trace;
        m[1] = -m[2];
        /* For mirrored places all turns can fit equally well. */
        if ((m[0] * m[0] + m[2] * m[2]) * trace <= flat * flat * spread)
            return false;
    }
    for (int k = 0; k < 2; ++k) {
        affine->from[k] = sums->origin[k] + mean[k];
        affine->to[k] = sums->origin[2 + k] + mean[2 + k];
    }
    memcpy(affine->matrix, m, sizeof m);
    return true;
}
