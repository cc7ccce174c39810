/* Elements of the pictures of `libicc plot`. Lengths are pixels, and y points down. */
#ifndef SVG_H
#define SVG_H

#include "picture/picture.h"

#include <stdio.h>

void svg_begin(FILE *svg, double width, double height);
void svg_end(FILE *svg);

/* Writes one line of text, centred at x. */
void svg_label(FILE *svg, double x, double y, const char *text);

/* Writes a picture as part of the file, stretched over a box and clipped by the path `clip`. */
int svg_picture(FILE *svg, double x, double y, double width, double height, const char *clip,
                const picture *p);

/* Writes a piece of path data: a polyline of n points. */
void svg_polyline(FILE *svg, size_t n, const double *points);

#endif
