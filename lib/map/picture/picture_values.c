/* Interpolates values, linearly or cubically. Cubic interpolation is that of R. Keys, Cubic
 * Convolution Interpolation for Digital Image Processing, 1981. It is exact for quadratic
 * functions. Pixels at the edge are continued beyond it.
 *
 * A sample is missing if the pixel that contains the place is missing. So the known area neither
 * grows nor shrinks. The value is interpolated from the known pixels around, and their weights are
 * scaled to a sum of 1. */
#include "map/picture/picture_values.h"

#include "base/minmax.h"

#include <math.h>
#include <string.h>

/* Up to four pixels along an axis: their weights, and which one contains the place. */
typedef struct taps {
    int n;
    int32_t at[4], own;
    double weights[4];
} taps;

static const double PLACES = 1048576; /* units of a place in a pixel: 2^20 */

bool iccp_picture_has_values(const icc_picture *source)
{
    return source->channels > 4 || source->bytes > 2 || source->has_nodata != 0 ||
           (source->interpolation != 0 && source->interpolation != ICC_INTERPOLATION_LINEAR);
}

static double get_sample(const icc_picture *p, int32_t column, int32_t row, int32_t channel)
{
    const uint8_t *at = (const uint8_t *)p->pixels + (size_t)row * p->stride +
                        ((size_t)column * (size_t)p->channels + (size_t)channel) * (size_t)p->bytes;
    uint16_t two;
    float four;
    double eight;
    switch (p->bytes) {
    case 1:
        return *at;
    case 2:
        memcpy(&two, at, sizeof two);
        return two;
    case 4:
        memcpy(&four, at, sizeof four);
        return (double)four;
    default:
        memcpy(&eight, at, sizeof eight);
        return eight;
    }
}

/* Writes a sample. Integers are rounded, halves upwards, and clamped to their range. */
static void put_sample(const icc_picture *p, void *pixel, int32_t channel, double value)
{
    uint8_t *at = (uint8_t *)pixel + (size_t)channel * (size_t)p->bytes;
    const double most = p->bytes == 1 ? UINT8_MAX : UINT16_MAX;
    const uint16_t two = (uint16_t)iccp_min(iccp_max(floor(value + 0.5), 0), most);
    const float four = (float)value;
    switch (p->bytes) {
    case 1:
        *at = (uint8_t)two;
        break;
    case 2:
        memcpy(at, &two, sizeof two);
        break;
    case 4:
        memcpy(at, &four, sizeof four);
        break;
    default:
        memcpy(at, &value, sizeof value);
    }
}

static bool is_missing(const icc_picture *p, double value)
{
    return p->has_nodata &&
           (isnan(p->nodata) ? isnan(value)
                             : !(value < p->nodata || value > p->nodata || isnan(value)));
}

/* Finds the taps for a place along an axis of n pixels, in pixels from its beginning. Places are
 * rounded, so that rounding errors of the map do not move a place off a pixel's centre. */
static taps find_taps(double where, int32_t n, int32_t interpolation)
{
    taps t = {.n = 1, .weights = {1}};
    const double last = n - 1, place = floor(where * PLACES + 0.5) / PLACES;
    t.own = (int32_t)iccp_min(iccp_max(floor(place), 0), last);
    t.at[0] = t.own;
    if (interpolation == ICC_INTERPOLATION_NEAREST)
        return t;
    const double x = iccp_min(iccp_max(place - 0.5, 0), last), before = floor(x), f = x - before;
    const bool cubic = interpolation == ICC_INTERPOLATION_CUBIC;
    const double linear[2] = {1 - f, f};
    const double keys[4] = {((2 - f) * f - 1) * f / 2, ((3 * f - 5) * f * f + 2) / 2,
                            ((4 - 3 * f) * f + 1) * f / 2, (f - 1) * f * f / 2};
    t.n = cubic ? 4 : 2;
    memcpy(t.weights, cubic ? keys : linear, (size_t)t.n * sizeof *keys);
    for (int k = 0; k < t.n; ++k)
        t.at[k] = (int32_t)iccp_min(iccp_max(before + k - (cubic ? 1 : 0), 0), last);
    return t;
}

/* Finds the value of a channel at a place. Returns false if it is missing. If a sample is missing,
 * cubic interpolation cannot give its weight to its neighbours, because some weights are negative.
 * Linear interpolation is used there. */
static bool get_value(const icc_picture *p, int32_t channel, const double place[2],
                      int32_t interpolation, double *value)
{
    const taps x = find_taps(place[0], p->width, interpolation);
    const taps y = find_taps(place[1], p->height, interpolation);
    double sum = 0, weight = 0;
    bool complete = true;
    if (is_missing(p, get_sample(p, x.own, y.own, channel)))
        return false;
    for (int j = 0; j < y.n; ++j)
        for (int i = 0; i < x.n; ++i) {
            const double w = x.weights[i] * y.weights[j];
            const double sample = get_sample(p, x.at[i], y.at[j], channel);
            const bool missing = is_missing(p, sample);
            complete = complete && !missing;
            /* A sample of weight 0 is skipped, because it may be infinite. */
            if (missing || !(w < 0 || w > 0))
                continue;
            sum += w * sample;
            weight += w;
        }
    if (!complete && interpolation == ICC_INTERPOLATION_CUBIC)
        return get_value(p, channel, place, ICC_INTERPOLATION_LINEAR, value);
    *value = complete ? sum : sum / weight;
    return true;
}

void iccp_picture_values_paint(const icc_picture *source, size_t n, const double *places,
                               void *pixel)
{
    for (int32_t c = 0; c < source->channels; ++c) {
        double sum = 0, value;
        size_t n_values = 0;
        for (size_t k = 0; k < n; ++k)
            if (!isnan(places[2 * k]) &&
                get_value(source, c, places + 2 * k, source->interpolation, &value)) {
                sum += value;
                ++n_values;
            }
        if (n_values > 0)
            put_sample(source, pixel, c, n_values > 1 ? sum / (double)n_values : sum);
        else if (source->has_nodata)
            put_sample(source, pixel, c, source->nodata);
    }
}
