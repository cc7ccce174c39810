/* The kernel width that suits a set of samples. */
#ifndef ICCP_SPECTRUM_H
#define ICCP_SPECTRUM_H

#include "base/env.h"

/* sigma of a grid, in spacings (3.28). */
#define ICCP_SIGMA_OF_GRID 0.95492965855137201 /* 3 / pi */

enum { ICCP_SPECTRUM_BINS = 96 };

/* Computes the power of n points, dim coordinates each, at the wave numbers step, 2 step, ... (in 2
 * pi per unit of length). It is the mean over directions of |sum exp(-i k x)|^2 / n, which is 1 for
 * random points. */
icc_status iccp_spectrum(size_t dim, size_t n, const double *points, double step,
                         double power[ICCP_SPECTRUM_BINS], const iccp_env *env);

/* Returns a width for evenly spread points about `spacing` apart. */
icc_status iccp_spectrum_sigma(size_t dim, size_t n, const double *points, double spacing,
                               double *sigma, const iccp_env *env);

#endif
