/* Two surfaces drawn on the sphere with their landmarks in the same places. */
#ifndef ICCP_LANDMARK_SPHERE_H
#define ICCP_LANDMARK_SPHERE_H

#include "match/sphere/split_surface.h"

/* Surfaces that are given, x by vertex, and landmarks, 4 to ICCP_MOST_SURFACE_LANDMARKS, as
 * iccp_landmark_paths() has them; edges of the surfaces are halved as there. Those behind the
 * first n_fixed are only likely: as many of them are taken as is best where there are few
 * vertices, and they are moved like others then. s, m and directions are made, for all vertices
 * that are there then; to be freed in any case. Both drawings are certified, landmarks of both,
 * but for those, have the same directions, whatever they are, and each drawing has been moved on
 * the other: see match/sphere/relax.h. ICC_ERR_RESOLUTION, ICC_ERR_CERTIFICATE, ICC_ERR_MEMORY,
 * ICC_ERR_CANCELLED. */
icc_status iccp_landmark_sphere_draw(double *directions[2], iccp_half_edges m[2],
                                     iccp_split_surface s[2], const iccp_half_edges *const given[2],
                                     const double *const x[2], size_t n, size_t n_fixed,
                                     const uint32_t *const vertices[2], const iccp_env *env,
                                     icc_error *err);

#endif
