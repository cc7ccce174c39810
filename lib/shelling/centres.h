/* Chooses the vertices of conforming meshes where the leaves of their foliations end. Source:
 * see centres.c. */
#ifndef ICCP_CENTRES_H
#define ICCP_CENTRES_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* The inner vertex farthest from the boundary. The mesh must have inner vertices. */
icc_status iccp_deepest_centre(const icc_domain *domain, const iccp_simplices *mesh,
                               uint32_t *centre, const iccp_env *env);

/* The inner vertex nearest to a local point. */
uint32_t iccp_nearest_centre(const iccp_simplices *mesh, const double *point);

/* Finds a pair of centres for two domains that correspond. A discretely harmonic map takes the
 * inside of the first mesh to the second domain. The first centre is the deepest vertex, where
 * the lesser of its own depth and its image's counts. Both depths are relative to their domains'
 * sizes. The second centre is a vertex near the image, and a deep one rather than the nearest.
 * `given`, unless NULL, is the centre of the first domain. Both meshes must have inner vertices. */
icc_status iccp_paired_centres(const icc_domain *const domain[2],
                               const iccp_simplices *const mesh[2], const uint32_t *given,
                               uint32_t centre[2], const iccp_env *env);

#endif
