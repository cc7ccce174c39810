/* Draws figures of weights as SVG. */
#ifndef WEIGHT_PLOT_H
#define WEIGHT_PLOT_H

#include "kernel/kernel_job.h"

/* Draws the weight of one handle over the shape, by colour and isolines (the thesis' figures 6.13
 * to 6.17). */
int plot_weight(kernel_job *k);

/* Draws the weights of all handles along a segment with n places (its figures 4.1 to 4.6). */
int plot_along(const kernel_job *k, size_t n, const double *weights);

/* The least magnitude on a logarithmic scale is 10 to the power of minus this. */
enum { DECADES = 10 };

/* The height of a weight in a figure: 0 at the bottom of the scale, 1 at the top. On a linear scale
 * it may lie outside. */
double weight_level(double weight, bool logarithmic);

/* The colour of a weight: red, green and blue from 0 to 255. Negative weights are red. */
void weight_colour(double weight, bool logarithmic, double rgb[3]);

/* A colour for each of n curves, as a string like #0123ef. */
const char *curve_colour(char out[8], size_t i, size_t n);

#endif
