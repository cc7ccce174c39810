/* Whether doubles have digits enough for a map along curves of method field. Each of its charts may
 * be one-to-one and bring every point back to rounding, and the map lose all digits between the
 * two: points that one chart tells apart are one to the other. */
#ifndef ICCP_DIGITS_H
#define ICCP_DIGITS_H

#include "chart/chart.h"

/* Fills in what `info` says of that, and takes the certificate away from a map that does not come
 * back, by evenly spread points of both domains and both ways. The charts are of method field and
 * certified. */
icc_status iccp_digits_check(const icc_chart *source, const icc_chart *target, icc_map_info *info,
                             const iccp_env *env);

/* As iccp_curves_points(), with ICC_ERR_TRACE for points whose images do not come back. */
icc_status iccp_digits_points(const icc_chart *from, const icc_chart *to, size_t n,
                              const double *points, double *images, icc_status *status,
                              iccp_path *path);

/* As iccp_curves_point() with a derivative; ICC_ERR_TRACE also where its determinant is not
 * positive. */
icc_status iccp_digits_point(const icc_chart *from, const icc_chart *to, const double *point,
                             double *image, double *jacobian, iccp_path *path);

#endif
