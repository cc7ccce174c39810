/* Two outlines whose vertices correspond already. */
#ifndef ICCP_ONE_TO_ONE_H
#define ICCP_ONE_TO_ONE_H

#include "match/outline/union_outline.h"

/* Puts each vertex of the source to one of the target in turn, where both have as many, nearly all
 * joins agree on that, so do all landmarks, and no edge is stretched too much. */
void iccp_one_to_one(iccp_union_outline *common, const iccp_outline *source,
                     const iccp_outline *target, size_t n_landmarks, const double *landmarks);

#endif
