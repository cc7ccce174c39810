/* Pictures whose samples are values rather than colours: numbers of any kind, many side by side, of
 * which some may be missing. One pixel at a time, in doubles. */
#ifndef ICCP_PICTURE_VALUES_H
#define ICCP_PICTURE_VALUES_H

#include "icc/icc.h"

#include <stdbool.h>

enum { ICCP_MOST_CHANNELS = 64 };

/* Whether the samplers of colours do not do: floats, more than four channels, missing samples,
 * other than linear interpolation. */
bool iccp_picture_has_values(const icc_picture *source);

/* Writes one pixel: for each channel the mean of the values at n places, in pixels from the corner
 * of the picture; those that are not a number, and what is missing, do not count. Where nothing
 * counts the pixel is missing. */
void iccp_picture_values_paint(const icc_picture *source, size_t n, const double *places,
                               void *pixel);

#endif
