/* Making, copying and widening pictures. */
#include "picture/picture.h"

#include "base/allocate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

picture picture_make(size_t width, size_t height, unsigned channels, unsigned depth)
{
    picture p = {.width = width, .height = height, .channels = channels, .depth = depth};
    if (depth > 16)
        p.values = need(width * height, channels * sizeof *p.values);
    else
        p.samples = need(width * height, channels * sizeof *p.samples);
    return p;
}

void picture_free(picture *p)
{
    free(p->samples);
    free(p->values);
    free(p->notes.profile);
    *p = (picture){0};
}

bool picture_is_plain(const picture *p)
{
    return p->values == NULL && p->channels <= 4;
}

bool picture_has_alpha(const picture *p)
{
    return picture_is_plain(p) && p->channels % 2 == 0;
}

picture picture_copy(const picture *p)
{
    picture copy = picture_make(p->width, p->height, p->channels, p->depth);
    size_t n = p->width * p->height * p->channels;
    if (p->values != NULL)
        memcpy(copy.values, p->values, n * sizeof *p->values);
    else
        memcpy(copy.samples, p->samples, n * sizeof *p->samples);
    return copy;
}

void picture_widen(picture *p, bool colour, bool alpha)
{
    bool has_colour = p->channels >= 3, has_alpha = picture_has_alpha(p);
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

void picture_turn(picture *p, unsigned orientation)
{
    bool swaps = orientation >= 5;
    bool mirrors[2] = {orientation == 2 || orientation == 3 || orientation == 6 || orientation == 7,
                       orientation == 3 || orientation == 4 || orientation >= 7};
    if (orientation <= 1)
        return;
    size_t size[2] = {p->width, p->height};
    picture turned = picture_make(size[swaps], size[!swaps], p->channels, p->depth);
    for (size_t i = 0; i < p->width * p->height; i++) {
        size_t at[2] = {i % p->width, i / p->width};
        size_t x = at[swaps], y = at[!swaps];
        x = mirrors[0] ? turned.width - 1 - x : x;
        y = mirrors[1] ? turned.height - 1 - y : y;
        memcpy(turned.samples + (y * turned.width + x) * p->channels, p->samples + i * p->channels,
               p->channels * sizeof *p->samples);
    }
    free(p->samples);
    p->samples = turned.samples;
    p->width = turned.width;
    p->height = turned.height;
    if (swaps) {
        uint32_t along_x = p->notes.density[0];
        p->notes.density[0] = p->notes.density[1];
        p->notes.density[1] = along_x;
    }
}

picture picture_canvas(picture *from, const unsigned char *background)
{
    if (background != NULL && from->values == NULL)
        picture_widen(from, background[0] != background[1] || background[0] != background[2],
                      background[3] < 255);
    picture canvas = picture_copy(from);
    for (size_t i = 0; background != NULL && i < canvas.width * canvas.height; i++)
        if (canvas.values == NULL)
            picture_set(&canvas, i, background);
        else
            for (size_t c = 0; c < canvas.channels; c++)
                canvas.values[i * canvas.channels + c] = NAN;
    return canvas;
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
