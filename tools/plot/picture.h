/* Pictures: grey, grey + alpha, RGB or RGBA, 8 or 16 bits a sample, rows from the top. */
#ifndef PICTURE_H
#define PICTURE_H

#include "base/say.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

typedef struct picture {
    size_t width, height;
    unsigned channels;     /* 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA */
    unsigned depth;        /* 8 or 16 */
    uint16_t *samples;     /* height * width * channels, each below 2^depth */
    struct png_keep *keep; /* what the file says about colour and size of pixels; may be NULL */
} picture;

/* A picture of zeros. */
picture picture_make(size_t width, size_t height, unsigned channels, unsigned depth);
void picture_free(picture *p);

/* A copy without `keep`. */
picture picture_copy(const picture *p);

/* Adds colour or an opaque alpha where the picture has none. */
void picture_widen(picture *p, bool colour, bool alpha);

/* Sets a pixel to 8-bit RGBA. The picture must have room for what the colour needs. */
void picture_set(picture *p, size_t pixel, const unsigned char rgba[4]);

/* Decodes a PNG, bytes[0..n) with bytes[n] == '\0'. Palettes and small depths are widened. False:
 * see `wrong`. */
bool picture_decode(picture *out, const char *bytes, size_t n, problem *wrong);

/* Encodes a PNG with what `keep` holds, which may come from another picture. NULL: see `wrong`. */
unsigned char *picture_encode(const picture *p, const struct png_keep *keep, size_t *n,
                              problem *wrong);

/* picture_decode() of a file that has been read, and picture_encode() to a file: DONE, or FAILED
 * with a line on stderr. */
int picture_take(picture *out, const char *name, const char *bytes, size_t n);
int picture_save(const picture *p, const struct png_keep *keep, const char *name);

/* What is drawn on: a copy, or all background if that is not NULL. `from` is widened as that needs
 * it. */
picture picture_canvas(picture *from, const unsigned char *background);

void png_keep_free(struct png_keep *keep);

#endif
