/* Closed surfaces drawn on the sphere: every vertex gets a direction, so that every face becomes a
 * triangle of the sphere, and these cover it once. */
#ifndef ICCP_SPHERE_H
#define ICCP_SPHERE_H

#include "match/surface/half_edges.h"

/* Directions (match/surface/direction.h) for the vertices of a closed surface without handles, 3
 * n_vertices numbers each, x of size about 1; vertices without faces get zeros. Faces that are
 * counter-clockwise from outside are so on the sphere. Areas and angles are kept as far as they can
 * be. Certified: see match/sphere/sphere_certificate.h.
 *
 * ICC_ERR_RESOLUTION if directions are too coarse for the surface; ICC_ERR_CERTIFICATE, which is
 * to say never; ICC_ERR_BOUNDARY for faces that are not of a closed surface; ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. O(n log n) for a bounded number of neighbours. The same on every machine. */
icc_status iccp_sphere_draw(double *directions, size_t n_vertices, const double *x, size_t n_faces,
                            const uint32_t *faces, const iccp_env *env, icc_error *err);

/* The factor by which a surface, all of it there, gets the area of the sphere. */
double iccp_sphere_scale(const iccp_half_edges *m, const double *x);

/* Whether a drawing, all of it there, is one-to-one: ICC_ERR_CERTIFICATE where it is not. */
icc_status iccp_sphere_check(const iccp_half_edges *m, const double *directions, icc_error *err);

/* As iccp_sphere_draw() for a surface that has been made coarse, until so many vertices are there:
 * those that are have directions, of a drawing that is one-to-one; or they are four, and none is
 * fixed: these get some. Those that are fixed, by vertex, stay; NULL: none is. `is_quiet`: so do
 * all that were there before. Certified once all vertices are there. */
icc_status iccp_sphere_grow(double *directions, iccp_half_edges *m, const double *x, double scale,
                            const uint8_t *is_fixed, bool is_quiet, size_t until,
                            const iccp_env *env, icc_error *err);

#endif
