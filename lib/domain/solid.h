/* Checks that a mask is a solid without holes. */
#ifndef ICCP_SOLID_H
#define ICCP_SOLID_H

#include "domain/mask.h"

/* Returns ICC_ERR_TOPOLOGY unless four conditions hold. The mask is connected through the cells'
 * faces. Its boundary is a manifold, so neither cells nor gaps touch only along an edge or a
 * corner. The outside is connected. The Euler characteristic is 1.
 *
 * Up to 3-D these make the mask a ball. In higher dimensions, holes of several dimensions may
 * cancel in the Euler characteristic and remain unnoticed here. */
icc_status iccp_mask_check(const iccp_mask *mask, const iccp_env *env, icc_error *err);

#endif
