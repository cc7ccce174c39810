/* The vertices of conforming meshes that the leaves of their foliations end at. */
#ifndef ICCP_CENTRES_H
#define ICCP_CENTRES_H

#include "domain/domain.h"
#include "geometry/simplices.h"

/* The inner vertex farthest from the boundary. The mesh has inner vertices. */
icc_status iccp_deepest_centre(const icc_domain *domain, const iccp_simplices *mesh,
                               uint32_t *centre, const iccp_env *env);

/* The inner vertex nearest to a local point. */
uint32_t iccp_nearest_centre(const iccp_simplices *mesh, const double *point);

/* A pair of centres for two domains that correspond: a discretely harmonic map takes the inside of
 * the first mesh to the second domain; the centre is the vertex that is deepest before and after,
 * by the lesser of the two depths, relative to the domains' sizes; the second domain's is a vertex
 * near its image, a deep one rather than the nearest. When `given` is not NULL it is the centre of
 * the first domain. Both meshes have inner vertices. */
icc_status iccp_paired_centres(const icc_domain *const domain[2],
                               const iccp_simplices *const mesh[2], const uint32_t *given,
                               uint32_t centre[2], const iccp_env *env);

#endif
