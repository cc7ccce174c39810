/* Bilinear interpolation of one sample. */
#include "plot/picture_sample.h"

#include <math.h>

/* The four pixels around a place in the picture, and their shares. */
typedef struct square {
    size_t pixels[4];
    double shares[4];
} square;

static square find_square(const picture *p, const double at[2])
{
    square c;
    double x = fmin(fmax(at[0] - 0.5, 0), (double)p->width - 1),
           y = fmin(fmax(at[1] - 0.5, 0), (double)p->height - 1);
    size_t left = (size_t)x, top = (size_t)y;
    double u = x - (double)left, v = y - (double)top;
    for (size_t k = 0; k < 4; k++) {
        size_t column = left + (k % 2 == 1 && left + 1 < p->width),
               row = top + (k / 2 == 1 && top + 1 < p->height);
        c.pixels[k] = row * p->width + column;
        c.shares[k] = (k % 2 == 1 ? u : 1 - u) * (k / 2 == 1 ? v : 1 - v);
    }
    return c;
}

/* Mixes bilinearly, each colour weighted by its alpha. */
static void mix(const picture *p, const square *at, uint16_t *to)
{
    bool has_alpha = picture_has_alpha(p);
    unsigned n_colours = p->channels - has_alpha;
    double sums[PICTURE_MOST_CHANNELS] = {0}, alphas = 0;
    for (size_t k = 0; k < 4; k++) {
        const uint16_t *sample = p->samples + p->channels * at->pixels[k];
        double alpha = has_alpha ? at->shares[k] * sample[n_colours] : at->shares[k];
        for (unsigned c = 0; c < n_colours; c++)
            sums[c] += alpha * sample[c];
        alphas += alpha;
    }
    for (unsigned c = 0; c < n_colours; c++)
        to[c] = alphas > 0 ? (uint16_t)(sums[c] / alphas + 0.5) : 0;
    if (has_alpha)
        to[n_colours] = (uint16_t)(alphas + 0.5);
}

/* Mixes floats without the missing ones. NaN if all are missing. */
static void mix_floats(const picture *p, const square *at, double *to)
{
    for (unsigned c = 0; c < p->channels; c++) {
        double sum = 0, shares = 0;
        for (size_t k = 0; k < 4; k++) {
            double value = p->values[p->channels * at->pixels[k] + c];
            if (at->shares[k] > 0 && !isnan(value)) {
                sum += at->shares[k] * value;
                shares += at->shares[k];
            }
        }
        to[c] = shares > 0 ? sum / shares : (double)NAN;
    }
}

void picture_sample(const picture *from, const double at[2], picture *to, size_t pixel)
{
    square s = find_square(from, at);
    if (from->values != NULL)
        mix_floats(from, &s, to->values + pixel * to->channels);
    else
        mix(from, &s, to->samples + pixel * to->channels);
}
