/* How far from a boundary a point may be and still count as on it. */
#ifndef ICCP_BAND_H
#define ICCP_BAND_H

#include "icc/icc.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* A point of a facet that the caller computes, as a mean of its vertices, is rounded to the doubles
 * near the caller's coordinates. Far from the origin these lie wider apart than `tolerance`; and
 * along each axis differently: a shape may be far away along one axis and thin along another. So
 * the band around a facet is what a box of half-widths `rounding` covers when its centre moves over
 * the facet. In local coordinates. */
typedef struct iccp_band {
    double tolerance;             /* points this close are on the boundary in any case */
    double rounding[ICC_MAX_DIM]; /* all 0 where `tolerance` covers them */
    double reach;                 /* no point farther away is on the boundary */
} iccp_band;

/* The band of a shape that has the longest side `longest`, and the given largest coordinates along
 * the axes before it was moved to the local origin. */
static inline iccp_band iccp_band_of(size_t dim, double longest, const double *largest)
{
    /* What icc.h promises: rounding of input files is of this order. In longest sides of the
     * box. */
    const double share = 1e-14;
    /* A mean of dim numbers by dim weights whose sum is 1, both rounded, is off by less than 2 dim
     * halves of a unit in the last place. */
    const double unit = (double)dim * 0x1p-52;
    iccp_band band = {.tolerance = share * longest, .reach = share * longest};
    double squares = 0;
    for (size_t k = 0; k < dim; ++k) {
        band.rounding[k] = unit * largest[k];
        squares += band.rounding[k] * band.rounding[k];
    }
    if (squares > band.tolerance * band.tolerance)
        band.reach = sqrt(squares);
    else
        for (size_t k = 0; k < dim; ++k)
            band.rounding[k] = 0;
    return band;
}

static inline bool iccp_band_is_wide(const iccp_band *band)
{
    return band->reach > band->tolerance;
}

/* Whether a point belongs to the band of a facet within reach: `gap` leads from the point to the
 * nearest one of the facet. The box around a point meets the plane across the gap when its
 * half-widths, seen along the gap, are together as long. */
static inline bool iccp_band_holds(const iccp_band *band, size_t dim, const double *gap)
{
    double distance2 = 0, width = 0;
    for (size_t k = 0; k < dim; ++k) {
        distance2 += gap[k] * gap[k];
        width += fabs(gap[k]) * band->rounding[k];
    }
    return distance2 <= band->tolerance * band->tolerance || distance2 <= width;
}

#endif
