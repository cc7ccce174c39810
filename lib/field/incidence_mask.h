/* Incidence of masks and grids whose simplices their boundary is made of. */
#ifndef ICCP_INCIDENCE_MASK_H
#define ICCP_INCIDENCE_MASK_H

#include "field/incidence.h"

/* Whether the domain is a mask, the walls between its cells lie in the lattice, and the grid
 * extends beyond. */
bool iccp_incidence_fits_mask(const iccp_incidence *incidence);

/* Fills the incidence, which has its arrays but for `facet`, where the mask fits. A facet meets a
 * simplex here in a common face of both, or in faces of the grid that are part of it: so it is
 * noted at the vertices that lie in it, and the simplices that meet it are those at these
 * vertices. */
icc_status iccp_incidence_mask(iccp_incidence *incidence, const iccp_orders *orders,
                               const iccp_env *env);

#endif
