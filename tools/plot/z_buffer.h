/* A picture of triangles and lines in space. Each sample has a depth, so that near parts hide those
 * behind. Places are in samples: x to the right, y down, z to the eye. */
#ifndef Z_BUFFER_H
#define Z_BUFFER_H

#include "picture/picture.h"

/* Samples along the side of a pixel. */
enum { Z_BUFFER_SAMPLES = 4 };

typedef struct z_buffer {
    size_t width, height; /* in samples */
    float *depths;        /* -HUGE_VALF if nothing is there */
    unsigned char *rgb;   /* three bytes for each sample */
} z_buffer;

typedef struct z_buffer_corner {
    double at[3], value[3];
} z_buffer_corner;

/* The colour of a place of a triangle with that value, each channel from 0 to 255. */
typedef void (*z_buffer_paint)(const void *of, const double value[3], double rgb[3]);

/* Makes an empty, white picture with this many pixels. */
z_buffer z_buffer_make(size_t width, size_t height);
void z_buffer_free(z_buffer *s);

/* Draws a triangle, whose corners' values are interpolated. A triangle seen edge-on is not
 * drawn. */
void z_buffer_triangle(z_buffer *s, const z_buffer_corner corners[3], z_buffer_paint paint,
                       const void *of);

/* Draws a line with round ends, as if it were nearer by `lift`. */
void z_buffer_line(z_buffer *s, const double a[3], const double b[3], double radius, double lift,
                   const unsigned char rgb[3]);

/* Draws contours where a sample's neighbour is farther away by `jump`. */
void z_buffer_contours(z_buffer *s, size_t radius, double jump, const unsigned char rgb[3]);

/* The picture: each pixel is the mean of its samples. */
picture z_buffer_picture(const z_buffer *s);

#endif
