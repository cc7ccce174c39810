/* The flux that the leaves of a foliation should carry: from the boundary to the star of one
 * vertex, without sources on the way.
 *
 * Fluxes are arrays over the sides of a mesh: what leaves the simplex through the side, negative
 * for what enters. The two sides of a facet add up to 0. The simplices at the centre, its star,
 * count as one sink; flux through sides at the centre is 0. */
#ifndef ICCP_REFERENCE_H
#define ICCP_REFERENCE_H

#include "geometry/simplices.h"

/* What enters through each facet of the domain, n_facets positive numbers that sum to 1:
 * `harmonic`, in [0,1), of it in proportion to the flux of a potential that is about harmonic, the
 * rest to the area. ICC_OK, ICC_ERR_MEMORY, ICC_ERR_CANCELLED or, when doubles cannot do it,
 * ICC_ERR_SOLVER. */
icc_status iccp_inflow(const iccp_simplices *mesh, uint32_t centre, double harmonic, double *inflow,
                       const iccp_env *env);

/* The harmonic flux with that inflow by Crouzeix-Raviart elements, and the mean potential of each
 * simplex, 0 at the star and rising with the distance from it. Fails as iccp_inflow() does. */
icc_status iccp_reference_flux(const iccp_simplices *mesh, uint32_t centre, const double *inflow,
                               double *flux, double *potential, const iccp_env *env);

#endif
