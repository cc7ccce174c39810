/* Is a mask a solid without holes? */
#ifndef ICCP_SOLID_H
#define ICCP_SOLID_H

#include "domain/mask.h"

/* ICC_ERR_TOPOLOGY unless the mask is one piece (through the cells' faces), its boundary is a
 * manifold (cells do not touch only along an edge or a corner, nor do gaps), the outside is one
 * piece, and the Euler characteristic is 1. Up to 3-D that makes it a ball. Beyond, holes of
 * several dimensions may cancel out in the Euler characteristic and remain unnoticed here. */
icc_status iccp_mask_check(const iccp_mask *mask, const iccp_env *env, icc_error *err);

#endif
