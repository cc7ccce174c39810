/* Colours between the centres of pixels. */
#ifndef PICTURE_SAMPLE_H
#define PICTURE_SAMPLE_H

#include "picture/picture.h"

/* Gives a pixel of `to` the colour of `from` at a place, bilinearly. Both have the same channels
 * and depth. */
void picture_sample(const picture *from, const double at[2], picture *to, size_t pixel);

#endif
