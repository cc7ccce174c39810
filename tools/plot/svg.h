/* What the pictures of `libicc plot` are made of. Lengths are pixels, y points down. */
#ifndef SVG_H
#define SVG_H

#include "plot/picture.h"

#include <stdio.h>

void svg_begin(FILE *svg, double width, double height);
void svg_end(FILE *svg);

/* One line of text, centred at x. */
void svg_label(FILE *svg, double x, double y, const char *text);

/* A picture as part of the file, stretched over a box and cut to the clip path `clip`. */
int svg_picture(FILE *svg, double x, double y, double width, double height, const char *clip,
                const picture *p);

/* A piece of path data: a polyline of n points. */
void svg_polyline(FILE *svg, size_t n, const double *points);

#endif
