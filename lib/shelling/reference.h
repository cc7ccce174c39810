/* The flux that the leaves of a foliation should carry: from the boundary to the star of one
 * vertex, without sources on the way. Source: see reference.c and inflow.c.
 *
 * Fluxes are arrays over the sides of a mesh. A flux is positive if it leaves the simplex
 * through the side, and negative if it enters. The two sides of a facet add up to 0. The star,
 * the simplices at the centre, counts as one sink. Flux through sides at the centre is 0. */
#ifndef ICCP_REFERENCE_H
#define ICCP_REFERENCE_H

#include "geometry/simplices.h"

/* Computes the inflow through each facet of the domain: n_facets positive numbers that sum to 1.
 * The share `harmonic`, in [0, 1), is proportional to the flux of an approximately harmonic
 * potential, and the rest to the area. Returns ICC_OK, ICC_ERR_MEMORY, ICC_ERR_CANCELLED, or
 * ICC_ERR_SOLVER if doubles are not precise enough. */
icc_status iccp_inflow(const iccp_simplices *mesh, uint32_t centre, double harmonic, double *inflow,
                       const iccp_env *env);

/* Computes the harmonic flux with that inflow by Crouzeix-Raviart elements, and the mean
 * potential of each simplex. The potential is 0 at the star and rises with the distance from it.
 * Fails as iccp_inflow() does. */
icc_status iccp_reference_flux(const iccp_simplices *mesh, uint32_t centre, const double *inflow,
                               double *flux, double *potential, const iccp_env *env);

#endif
