#include "plot/picture.h"

#include "base/allocate.h"

#include <stdlib.h>
#include <string.h>

picture picture_make(size_t width, size_t height, unsigned channels, unsigned depth)
{
    picture p = {.width = width, .height = height, .channels = channels, .depth = depth};
    p.samples = need(width * height, channels * sizeof *p.samples);
    return p;
}

void picture_free(picture *p)
{
    free(p->samples);
    png_keep_free(p->keep);
    *p = (picture){0};
}

picture picture_copy(const picture *p)
{
    picture copy = picture_make(p->width, p->height, p->channels, p->depth);
    memcpy(copy.samples, p->samples, p->width * p->height * p->channels * sizeof *p->samples);
    return copy;
}

void picture_widen(picture *p, bool colour, bool alpha)
{
    bool has_colour = p->channels >= 3, has_alpha = p->channels % 2 == 0;
    unsigned n_colours = colour || has_colour ? 3 : 1;
    unsigned channels = n_colours + (alpha || has_alpha);
    if (channels == p->channels)
        return;
    picture wide = picture_make(p->width, p->height, channels, p->depth);
    uint16_t opaque = (uint16_t)((1u << p->depth) - 1);
    for (size_t i = 0; i < p->width * p->height; i++) {
        const uint16_t *from = p->samples + i * p->channels;
        uint16_t *to = wide.samples + i * channels;
        for (unsigned c = 0; c < n_colours; c++)
            to[c] = from[has_colour ? c : 0];
        if (channels > n_colours)
            to[n_colours] = has_alpha ? from[p->channels - 1] : opaque;
    }
    free(p->samples);
    p->samples = wide.samples;
    p->channels = channels;
}

void picture_set(picture *p, size_t pixel, const unsigned char rgba[4])
{
    uint16_t *to = p->samples + pixel * p->channels;
    unsigned scale = p->depth == 16 ? 257 : 1, n_colours = p->channels >= 3 ? 3 : 1;
    for (unsigned c = 0; c < n_colours; c++)
        to[c] = (uint16_t)(rgba[c] * scale);
    if (p->channels > n_colours)
        to[n_colours] = (uint16_t)(rgba[3] * scale);
}
