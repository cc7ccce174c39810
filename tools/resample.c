#include "resample.h"

#include <math.h>

static size_t clamped(double i, size_t n)
{
    return i <= 0 ? 0 : i >= (double)(n - 1) ? n - 1 : (size_t)i;
}

void mixture_add(mixture *m, const picture *p, double x, double y)
{
    /* The sample (i, j) stands at the pixel's centre (i + 1/2, j + 1/2). */
    double left = floor(x - 0.5), top = floor(y - 0.5), u = x - 0.5 - left, v = y - 0.5 - top;
    size_t columns[2] = {clamped(left, p->width), clamped(left + 1, p->width)};
    size_t rows[2] = {clamped(top, p->height), clamped(top + 1, p->height)};
    unsigned n_colours = p->channels >= 3 ? 3 : 1;
    for (int k = 0; k < 4; k++) {
        double weight = (k & 1 ? u : 1 - u) * (k & 2 ? v : 1 - v);
        const uint16_t *s = p->samples + (rows[k >> 1] * p->width + columns[k & 1]) * p->channels;
        double alpha = p->channels > n_colours ? s[n_colours] : 1;
        for (unsigned c = 0; c < p->channels; c++)
            m->plain[c] += weight * s[c];
        for (unsigned c = 0; c < n_colours; c++)
            m->weighted[c] += weight * alpha * s[c];
    }
    m->n++;
}

void mixture_store(const mixture *m, picture *p, size_t pixel)
{
    uint16_t *to = p->samples + pixel * p->channels;
    unsigned n_colours = p->channels >= 3 ? 3 : 1;
    /* An alpha that rounds to 0 has no colour to weight by. */
    bool by_alpha = p->channels > n_colours && m->plain[n_colours] >= 0.5 * m->n;
    double largest = (double)((1u << p->depth) - 1);
    for (unsigned c = 0; c < p->channels; c++) {
        double value =
            by_alpha && c < n_colours ? m->weighted[c] / m->plain[n_colours] : m->plain[c] / m->n;
        to[c] = (uint16_t)fmin(floor(value + 0.5), largest);
    }
}
