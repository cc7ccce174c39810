/* Pictures: grey, grey + alpha, RGB or RGBA, with samples of 8 or 16 bits and rows from the top.
 * Also arrays that are no plain pictures: of floats, or with more channels. These have no alpha.
 *
 * Words of this folder
 * - sample: the number of a channel in a pixel. value: the same as a float.
 * - notes: what a file says about colours and the size of pixels.
 * - style: how a picture is written.
 *
 * picture_file.h reads and writes files; a format is a file NAME_io.c with a decoder and an
 * encoder. Begin with picture_file.c. */
#ifndef PICTURE_H
#define PICTURE_H

#include "base/say.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { PICTURE_MOST_CHANNELS = 64 };

typedef enum picture_format {
    PICTURE_NONE,
    PICTURE_PNG,
    PICTURE_JPEG,
    PICTURE_NPY,
    PICTURE_PGM,
    PICTURE_PPM,
    PICTURE_PNM, /* PGM or PPM, whichever fits */
    PICTURE_PAM
} picture_format;

/* Notes in a picture's file about its colours and the size of its pixels. They are neither
 * interpreted nor changed. */
typedef struct picture_notes {
    bool has_gamma, has_primaries, has_intent;
    int32_t gamma, primaries[8]; /* in 1/100000, as PNG's gAMA and cHRM: white, red, green, blue */
    int32_t intent;              /* of PNG's sRGB */
    char profile_name[80];
    unsigned char *profile; /* an ICC profile of n_profile bytes, or NULL */
    size_t n_profile;
    uint32_t density[2]; /* pixels along x and y; 0, 0: not given */
    bool per_metre;      /* if false, only the ratio of the two has a meaning */
    bool has_axis;       /* of an array: it has an axis for channels, even if there is only one */
} picture_notes;

typedef struct picture {
    size_t width, height;
    unsigned channels; /* 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA; more in an array */
    unsigned depth;    /* 8 or 16; of floats 32 or 64 */
    uint16_t *samples; /* height * width * channels, each below 2^depth; NULL for floats */
    double *values;    /* the same number of floats, NaN if missing; else NULL */
    picture_format format;
    picture_notes notes;
} picture;

/* How to write a picture. `notes` may be those of another picture, or NULL. */
typedef struct picture_style {
    picture_format format;
    const picture_notes *notes;
    int32_t quality; /* of JPEG: 1 to 100; 0: 92 */
} picture_style;

/* A picture of zeros. */
picture picture_make(size_t width, size_t height, unsigned channels, unsigned depth);
void picture_free(picture *p);

/* True if picture files can store it: no floats, at most four channels. */
bool picture_is_plain(const picture *p);
bool picture_has_alpha(const picture *p);

/* A copy without notes. */
picture picture_copy(const picture *p);

/* Adds colour or an opaque alpha channel if the plain picture has none. */
void picture_widen(picture *p, bool colour, bool alpha);

/* Turns and mirrors a picture to its intended orientation, an Exif number from 1 (unchanged) to
 * 8. */
void picture_turn(picture *p, unsigned orientation);

/* Sets a pixel to 8-bit RGBA. The picture must be plain and have the channels that the colour
 * needs. */
void picture_set(picture *p, size_t pixel, const unsigned char rgba[4]);

/* Makes the picture that is drawn on: a copy, or filled with `background` if that is not NULL;
 * floats are then missing. Adds channels to `from` if needed. With a background, `from` is plain or
 * of floats. */
picture picture_canvas(picture *from, const unsigned char *background);

#endif
