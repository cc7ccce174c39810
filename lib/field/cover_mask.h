/* Covers of masks on grids whose simplices their boundary is made of. */
#ifndef ICCP_COVER_MASK_H
#define ICCP_COVER_MASK_H

#include "field/cover.h"

/* Whether the domain is a mask, the walls between its cells lie in the lattice, and the grid
 * extends beyond. */
bool iccp_cover_fits_mask(const iccp_cover *cover);

/* Fills the cover, which has its arrays but for `facet`, where the mask fits. A facet meets a
 * simplex here in a common face of both, or in faces of the grid that are part of it: so it is
 * noted at the vertices that lie in it, and the simplices that meet it are those at these
 * vertices. */
icc_status iccp_cover_mask(iccp_cover *cover, const iccp_orders *orders, const iccp_env *env);

#endif
