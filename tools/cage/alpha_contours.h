/* The contours of what is opaque in a picture: curves along which the alpha is half of the most. */
#ifndef ALPHA_CONTOURS_H
#define ALPHA_CONTOURS_H

#include "picture/picture.h"

/* Closed polygons that neither cross nor touch. The opaque part lies on the same side of all. */
typedef struct alpha_contours {
    size_t n;       /* vertices */
    double *points; /* 2 n; pixel (i, j) covers [i, i + 1] x [j, j + 1] */
    size_t n_contours;
    size_t *firsts; /* the first vertex of each */
} alpha_contours;

/* Finds the contours of a plain picture with an alpha. Between the centres of pixels alpha is
 * linear, and outside the picture everything is transparent. */
alpha_contours alpha_contours_find(const picture *p);
void alpha_contours_free(alpha_contours *c);

#endif
