/* Pictures whose samples are values instead of colours: numbers of any type, with any number of
 * channels, some of which may be missing. Works in doubles, one pixel at a time. */
#ifndef ICCP_PICTURE_VALUES_H
#define ICCP_PICTURE_VALUES_H

#include "icc/icc.h"

#include <stdbool.h>

enum { ICCP_MOST_CHANNELS = 64 };

/* Returns true if the samplers for colours cannot be used. They cannot handle floats, more than
 * four channels, missing samples, or interpolations other than linear. */
bool iccp_picture_has_values(const icc_picture *source);

/* Writes one pixel: the mean of each channel over n places, in pixels from the corner of the
 * picture. Places that are not numbers and missing samples do not count. If nothing counts, the
 * pixel is missing. */
void iccp_picture_values_paint(const icc_picture *source, size_t n, const double *places,
                               void *pixel);

#endif
