/* Checking polygons as the caller gives them, and saying what is wrong. */
#ifndef ICCP_POLYGON_CHECK_H
#define ICCP_POLYGON_CHECK_H

#include "geometry/frame.h"
#include "geometry/polygon.h"

/* ICC_ERR_BOUNDARY unless there are as many as a ring has; the facets may be NULL. */
icc_status iccp_polygon_check_counts(size_t n_vertices, size_t n_facets, const uint32_t *facets,
                                     icc_error *err);

/* ICC_ERR_BOUNDARY for a vertex that is not finite. */
icc_status iccp_polygon_check_finite(size_t n, const double *vertices, icc_error *err);

/* Writes the local coordinates of finite vertices. ICC_ERR_BOUNDARY for one too near an axis of the
 * frame to work with exactly. */
icc_status iccp_polygon_bring_in(const iccp_frame *frame, double *local, size_t n,
                                 const double *vertices, icc_error *err);

/* Both, with a frame that is fitted to the vertices. */
icc_status iccp_polygon_localise(iccp_frame *frame, double *local, size_t n, const double *vertices,
                                 icc_error *err);

/* ICC_ERR_BOUNDARY unless the polygon, of at least 3 points, is simple. */
icc_status iccp_polygon_check(const iccp_polygon *polygon, const iccp_frame *frame,
                              const iccp_env *env, icc_error *err);

/* The same for n local points by themselves: polygon[0], polygon[1], .. of `points`, or all in
 * their order (NULL). ICC_ERR_BOUNDARY also when there are fewer than 3. */
icc_status iccp_polygon_check_points(size_t n, const double *points, const uint32_t *polygon,
                                     const iccp_frame *frame, const iccp_env *env, icc_error *err);

/* +1 counter-clockwise, -1 clockwise: exact for a simple polygon. */
int iccp_polygon_orientation(const iccp_polygon *polygon);

/* The area, in local units; accurate to a few units in the last place but for very thin shapes. */
double iccp_polygon_area(const iccp_polygon *polygon);

/* See icc_boundary_defects(). */
icc_status iccp_boundary_defects(size_t n, const double *vertices, size_t capacity, int32_t *kinds,
                                 uint32_t *items, size_t *n_defects, const iccp_env *env,
                                 icc_error *err);

#endif
