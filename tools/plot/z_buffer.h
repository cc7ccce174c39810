/* A picture of triangles and lines in space, with a depth for each of its samples, so that what is
 * nearer hides what is behind it. Places are in samples: x to the right, y down, z to the eye. */
#ifndef Z_BUFFER_H
#define Z_BUFFER_H

#include "plot/picture.h"

/* Samples along the side of a pixel. */
enum { Z_BUFFER_SAMPLES = 4 };

typedef struct z_buffer {
    size_t width, height; /* in samples */
    float *depths;        /* -HUGE_VALF: nothing is there */
    unsigned char *rgb;   /* three bytes a sample */
} z_buffer;

typedef struct z_buffer_corner {
    double at[3], value[3];
} z_buffer_corner;

/* The colour, each channel from 0 to 255, of a place of a triangle with that value. */
typedef void (*z_buffer_paint)(const void *of, const double value[3], double rgb[3]);

/* An empty, white one of so many pixels. */
z_buffer z_buffer_make(size_t width, size_t height);
void z_buffer_free(z_buffer *s);

/* A triangle; values are interpolated between its corners. One that is seen edge-on is nothing. */
void z_buffer_triangle(z_buffer *s, const z_buffer_corner corners[3], z_buffer_paint paint,
                       const void *of);

/* A line with round ends, drawn as if it were nearer by `lift`. */
void z_buffer_line(z_buffer *s, const double a[3], const double b[3], double radius, double lift,
                   const unsigned char rgb[3]);

/* Draws contours where what is behind a sample's neighbour is farther away by `jump`. */
void z_buffer_contours(z_buffer *s, size_t radius, double jump, const unsigned char rgb[3]);

/* Pixels, the means of their samples. */
picture z_buffer_picture(const z_buffer *s);

#endif
