/* Curve maps: they map point by point through two charts.
 *
 * Source: Huynh and Gingold, Bijective Deformations in R^n via Integral Curve Coordinates, section
 * 4. docs/theory/charts-space.md, "fields on grids", has the volumes.
 *
 * Words of this folder
 * - curve map: a map of kind ICC_MAP_CURVES, which has no mesh of its own.
 * - share: the part of a domain's measure near a point, per piece of a facet and of the curve.
 * - round trip: mapping a point, and mapping its image back (round_trip.h). A point comes back if
 *   the result is near it.
 * - guarded: a map that checks whether images come back, point by point.
 *
 * Invariants: a curve map is certified if both charts are. With charts of method field, samples
 * must also come back. Then a suspect image that does not come back is refused.
 *
 * Ways: curves.c maps, round_trip.c checks, curves_certificate.c certifies. curves_kind.c connects
 * them to the table in map/kind/kind.h. Begin with this file. */
#ifndef ICCP_CURVES_H
#define ICCP_CURVES_H

#include "chart/chart.h"

/* Maps one point from one chart's domain to the other's, in the callers' coordinates. `jacobian`
 * has room for dim * dim numbers, or is NULL. On failure the image is NaN and the Jacobian
 * undefined. */
icc_status iccp_curves_point(const icc_chart *from, const icc_chart *to, const double *point,
                             double *image, double *jacobian, iccp_path *path);

/* Logarithms of the shares of the domains' measures near a point and near its image. Both are
 * for the same piece of a facet and of the curve. Their difference tells how much the map
 * shrinks there. Both are 0 on the boundary and at the maximum. */
typedef struct iccp_shares {
    double from, to;
} iccp_shares;

/* Maps at most ICCP_CHART_MANY points without derivatives. `status` gets the outcome of each
 * point, and the return value is an error that concerns all of them. `shares` may be NULL, and
 * must be unless the charts are of method field. The shares of points that fail are undefined. */
icc_status iccp_curves_points(const icc_chart *from, const icc_chart *to, size_t n,
                              const double *points, double *images, iccp_shares *shares,
                              icc_status *status, iccp_path *path);

#endif
