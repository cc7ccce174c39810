/* Checks polygons that the caller gives, and describes their defects. */
#ifndef ICCP_POLYGON_CHECK_H
#define ICCP_POLYGON_CHECK_H

#include "geometry/frame.h"
#include "geometry/polygon.h"

/* Returns ICC_ERR_BOUNDARY unless the numbers fit a ring. `facets` may be NULL. */
icc_status iccp_polygon_check_counts(size_t n_vertices, size_t n_facets, const uint32_t *facets,
                                     icc_error *err);

/* Returns ICC_ERR_BOUNDARY if a vertex is not finite. */
icc_status iccp_polygon_check_finite(size_t n, const double *vertices, icc_error *err);

/* Writes the local coordinates of finite vertices. Returns ICC_ERR_BOUNDARY if a vertex is too near
 * an axis of the frame for exact computation. */
icc_status iccp_polygon_bring_in(const iccp_frame *frame, double *local, size_t n,
                                 const double *vertices, icc_error *err);

/* Fits a frame to the vertices, and writes their local coordinates. */
icc_status iccp_polygon_localise(iccp_frame *frame, double *local, size_t n, const double *vertices,
                                 icc_error *err);

/* Returns ICC_ERR_BOUNDARY unless the polygon, of at least 3 points, is simple. */
icc_status iccp_polygon_check(const iccp_polygon *polygon, const iccp_frame *frame,
                              const iccp_env *env, icc_error *err);

/* Like iccp_polygon_check(), for n local points: polygon[0], polygon[1], .. of `points`, or all in
 * their order if `polygon` is NULL. Also returns ICC_ERR_BOUNDARY for fewer than 3 points. */
icc_status iccp_polygon_check_points(size_t n, const double *points, const uint32_t *polygon,
                                     const iccp_frame *frame, const iccp_env *env, icc_error *err);

/* Returns +1 for counter-clockwise, -1 for clockwise. Exact for a simple polygon. */
int iccp_polygon_orientation(const iccp_polygon *polygon);

/* Returns the area in local units. Accurate to a few units in the last place, except for very thin
 * shapes. */
double iccp_polygon_area(const iccp_polygon *polygon);

/* See icc_boundary_defects(). */
icc_status iccp_boundary_defects(size_t n, const double *vertices, size_t capacity, int32_t *kinds,
                                 uint32_t *items, size_t *n_defects, const iccp_env *env,
                                 icc_error *err);

#endif
