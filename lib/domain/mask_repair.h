/* Repairs masks whose cells touch only along an edge or a corner. */
#ifndef ICCP_MASK_REPAIR_H
#define ICCP_MASK_REPAIR_H

#include "domain/mask.h"

/* Fills cells until no others touch only there, or until every further filling would create more
 * such contacts; see icc_mask_repair(). */
icc_status iccp_mask_repair(iccp_mask *mask, size_t *n_filled, const iccp_env *env);

#endif
