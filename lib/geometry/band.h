/* The boundary band: how far from a boundary a point may be and still count as on it. */
#ifndef ICCP_BAND_H
#define ICCP_BAND_H

#include "icc/icc.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

/* When a caller computes a point of a facet, as a mean of its vertices, the result is rounded to
 * doubles near the caller's coordinates. Far from the origin the gaps between doubles exceed
 * `tolerance`. They also differ by axis, because a shape may be far away along one axis and thin
 * along another. So the band around a facet is the region that a box of half-widths `rounding`
 * covers when its centre moves over the facet. In local coordinates. */
typedef struct iccp_band {
    double tolerance;             /* points this close are always on the boundary */
    double rounding[ICC_MAX_DIM]; /* all 0 if `tolerance` is larger */
    double reach;                 /* points farther away are never on the boundary */
} iccp_band;

/* Returns the band of a shape. `longest` is its longest side, and `largest` has the largest
 * coordinates along the axes before the shape was moved to the local origin. */
static inline iccp_band iccp_band_of(size_t dim, double longest, const double *largest)
{
    /* Promised by icc.h: rounding of input files has this order of magnitude. In units of the box's
     * longest side. */
    const double share = 1e-14;
    /* A mean of dim numbers by dim weights of sum 1, both rounded, has an error below 2 dim halves
     * of a unit in the last place. */
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

/* Returns true if a point within `reach` belongs to the band of a facet. `gap` leads from the point
 * to the nearest point of the facet. The box around the point meets the plane across the gap if the
 * sum of its half-widths, seen along the gap, is at least the gap's length. */
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
