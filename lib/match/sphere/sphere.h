/* Draws closed surfaces on the sphere. Every vertex gets a direction, so that every face becomes a
 * triangle on the sphere and these cover it once. */
#ifndef ICCP_SPHERE_H
#define ICCP_SPHERE_H

#include "match/surface/half_edges.h"

/* Finds directions (match/surface/direction.h) for the vertices of a closed surface without
 * handles, 3 n_vertices numbers. x has coordinates of size about 1. Vertices without faces get
 * zeros. Faces that are counter-clockwise from outside stay so on the sphere. Areas and angles
 * change as little as possible. The drawing is certified: see match/sphere/sphere_certificate.h.
 *
 * ICC_ERR_RESOLUTION if directions are too coarse for the surface. ICC_ERR_BOUNDARY if the faces
 * are not a closed surface. ICC_ERR_CERTIFICATE, which should never happen. ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. O(n log n) for a bounded number of neighbours. The same on every machine. */
icc_status iccp_sphere_draw(double *directions, size_t n_vertices, const double *x, size_t n_faces,
                            const uint32_t *faces, const iccp_env *env, icc_error *err);

/* The factor by which a complete surface gets the area of the sphere. */
double iccp_sphere_scale(const iccp_half_edges *m, const double *x);

/* Checks that a complete drawing is one-to-one. ICC_ERR_CERTIFICATE if it is not. */
icc_status iccp_sphere_check(const iccp_half_edges *m, const double *directions, icc_error *err);

/* Continues a drawing of a coarse surface until `until` vertices are present. The vertices present
 * at first have directions of a one-to-one drawing. If they are four and none is fixed, they get
 * directions here. Fixed vertices do not move; `is_fixed` is by vertex, or NULL. With `is_quiet`,
 * no vertex present before moves. The drawing is certified once all vertices are present. */
icc_status iccp_sphere_grow(double *directions, iccp_half_edges *m, const double *x, double scale,
                            const uint8_t *is_fixed, bool is_quiet, size_t until,
                            const iccp_env *env, icc_error *err);

#endif
