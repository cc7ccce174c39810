#include "match/coverage/layer_affine.h"

#include "math/elementary.h"

#include <string.h>

/* Places whose spread across is less than this share of that along count as lying on a line. Any
 * small number would do: an affine map across a line is a guess, a similarity is not. Places whose
 * spread is less than this share of the layer's size count as one place, such as the centres of a
 * lake and of an island in it. */
static const double flat = 0.01;

/* Centre and diagonal of a layer's bounding box. */
static double box_of(const iccp_layer *layer, double *centre)
{
    double lower[2], upper[2];
    iccp_frame_bounds(2, layer->n, layer->place, lower, upper);
    for (int k = 0; k < 2; ++k)
        centre[k] = (lower[k] + upper[k]) / 2;
    return iccp_hypot(upper[0] - lower[0], upper[1] - lower[1]);
}

static void fit_boxes(iccp_layer_affine *affine, size_t n, const double *pairs,
                      const iccp_layer *source, const iccp_layer *target)
{
    const double size = box_of(source, affine->from);
    const double scale = size > 0 ? box_of(target, affine->to) / size : 1;
    for (int k = 0; k < 2 && n > 0; ++k) {
        affine->from[k] = pairs[k];
        affine->to[k] = pairs[2 + k];
    }
    affine->matrix[0] = affine->matrix[3] = scale;
    affine->matrix[1] = affine->matrix[2] = 0;
}

/* Returns true if n places, with this sum of squared distances from their mean, are spread out. */
static bool is_spread(double sum, size_t n, const iccp_layer *layer)
{
    double centre[2];
    const double least = flat * box_of(layer, centre);
    return sum > (double)n * least * least;
}

void iccp_layer_affine_fit(iccp_layer_affine *affine, size_t n, const double *pairs,
                           const iccp_layer *source, const iccp_layer *target)
{
    double mean[4] = {0}, s[3] = {0}, c[4] = {0}, spread = 0;
    for (size_t k = 0; k < 4 * n; ++k)
        mean[k % 4] += pairs[k] / (double)n;
    for (size_t k = 0; k < n; ++k) {
        const double p[2] = {pairs[4 * k] - mean[0], pairs[4 * k + 1] - mean[1]};
        const double q[2] = {pairs[4 * k + 2] - mean[2], pairs[4 * k + 3] - mean[3]};
        s[0] += p[0] * p[0];
        s[1] += p[0] * p[1];
        s[2] += p[1] * p[1];
        spread += q[0] * q[0] + q[1] * q[1];
        for (int e = 0; e < 4; ++e)
            c[e] += q[e / 2] * p[e % 2];
    }
    fit_boxes(affine, n, pairs, source, target);
    const double trace = s[0] + s[2], det = s[0] * s[2] - s[1] * s[1];
    if (!is_spread(trace, n, source) || !is_spread(spread, n, target))
        return;
    double m[4] = {0};
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
            return;
    }
    for (int k = 0; k < 2; ++k) {
        affine->from[k] = mean[k];
        affine->to[k] = mean[2 + k];
    }
    memcpy(affine->matrix, m, sizeof m);
}
