/* Colours between pixels. */
#ifndef RESAMPLE_H
#define RESAMPLE_H

#include "picture.h"

/* Sums of samples; a mean in the end. Colours are weighted by their alpha, so that what is fully
 * transparent does not bleed; where nothing is opaque the plain mean is kept. */
typedef struct mixture {
    double n;
    double plain[4];    /* every channel */
    double weighted[3]; /* colour times alpha */
} mixture;

/* Adds the bilinear sample at (x, y), in units of pixels; beyond its rim the picture goes on with
 * the colour of the rim. */
void mixture_add(mixture *m, const picture *p, double x, double y);

/* Sets a pixel to the mean of what was added. */
void mixture_store(const mixture *m, picture *p, size_t pixel);

#endif
