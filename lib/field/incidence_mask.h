/* Incidence of masks whose boundary consists of faces of the grid's simplices. Source:
 * docs/theory/charts-space.md, "fields on grids", step 4. */
#ifndef ICCP_INCIDENCE_MASK_H
#define ICCP_INCIDENCE_MASK_H

#include "field/incidence.h"

/* Returns true if the domain is a mask, the walls between its cells lie in the lattice, and the
 * grid extends beyond the mask. */
bool iccp_incidence_fits_mask(const iccp_incidence *incidence);

/* Fills the incidence of a mask that fits. All its arrays but `facet` must exist. A facet meets
 * a simplex in a common face, or in faces of the grid that are part of the facet. So the facet
 * is noted at its vertices, and it meets the simplices at these vertices. */
icc_status iccp_incidence_mask(iccp_incidence *incidence, const iccp_orders *orders,
                               const iccp_env *env);

#endif
