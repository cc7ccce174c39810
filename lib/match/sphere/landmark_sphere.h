/* Draws two surfaces on the sphere with their landmarks at the same directions. */
#ifndef ICCP_LANDMARK_SPHERE_H
#define ICCP_LANDMARK_SPHERE_H

#include "match/sphere/split_surface.h"

/* Draws two given surfaces with 4 to ICCP_MOST_SURFACE_LANDMARKS landmarks, as described at
 * iccp_landmark_paths(). x has coordinates by vertex. Edges may be halved. Landmarks after the
 * first n_fixed are guesses. The best number of them is used while vertices are few; later they
 * move like other vertices.
 *
 * s, m and directions are made for all vertices, including the new ones. Free them in any case.
 * Both drawings are certified, and each has been moved on the other (match/sphere/relax.h). Both
 * directions of a landmark are equal, except for guesses. ICC_ERR_RESOLUTION, ICC_ERR_CERTIFICATE,
 * ICC_ERR_MEMORY, ICC_ERR_CANCELLED. */
icc_status iccp_landmark_sphere_draw(double *directions[2], iccp_half_edges m[2],
                                     iccp_split_surface s[2], const iccp_half_edges *const given[2],
                                     const double *const x[2], size_t n, size_t n_fixed,
                                     const uint32_t *const vertices[2], const iccp_env *env,
                                     icc_error *err);

#endif
