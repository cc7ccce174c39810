/* Checks whether doubles have enough digits for a curve map with charts of method field. Each chart
 * may be one-to-one and bring every point back up to rounding, and the map may still lose all
 * digits. The reason is that points which one chart distinguishes may be the same for the other.
 *
 * Source: docs/theory/charts-space.md, "fields on grids". */
#ifndef ICCP_ROUND_TRIP_H
#define ICCP_ROUND_TRIP_H

#include "chart/chart.h"
#include "map/kind/map_facts.h"

/* Fills in the members of `info` on this check. Clears `certified` if points do not come back.
 * It tests evenly spread points of both domains in both directions. The charts must be of method
 * field and certified. */
icc_status iccp_round_trip_check(const icc_chart *source, const icc_chart *target,
                                 iccp_map_facts *info, const iccp_env *env);

/* Like iccp_curves_points(), but with ICC_ERR_TRACE for suspect points whose images do not come
 * back. */
icc_status iccp_checked_points(const icc_chart *from, const icc_chart *to, size_t n,
                               const double *points, double *images, icc_status *status,
                               iccp_path *path);

/* Like iccp_curves_point() with a derivative, but fails with ICC_ERR_TRACE if the image does not
 * come back or the determinant is not positive. */
icc_status iccp_checked_point(const icc_chart *from, const icc_chart *to, const double *point,
                              double *image, double *jacobian, iccp_path *path);

#endif
