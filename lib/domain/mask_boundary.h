/* Makes the domain of a mask. */
#ifndef ICCP_MASK_BOUNDARY_H
#define ICCP_MASK_BOUNDARY_H

#include "domain/domain.h"
#include "domain/mask.h"

/* See icc_domain_create_mask(). The shape has no zeros. The domain keeps the mask. */
icc_status iccp_domain_create_mask(icc_domain **out, int32_t dim, const size_t *shape,
                                   const uint8_t *cells, const iccp_env *env, icc_error *err);

#endif
