/* Pairs two outlines whose vertices correspond already. */
#ifndef ICCP_ONE_TO_ONE_H
#define ICCP_ONE_TO_ONE_H

#include "match/outline/union_outline.h"

/* Pairs the vertices of both outlines one by one if this is plausible. Both must have equally many,
 * nearly all joins and all landmarks must agree on the shift, and no edge may be stretched too
 * much. */
void iccp_one_to_one(iccp_union_outline *common, const iccp_outline *source,
                     const iccp_outline *target, size_t n_landmarks, const double *landmarks);

#endif
