/* Cages on the way from one to another. */
#ifndef CAGE_BETWEEN_H
#define CAGE_BETWEEN_H

#include "cage/cage.h"

/* The polygon at a share, between 0 and 1, of the straight way from `a` to `b`, with what lies inside; without lines and
 * ties. Both correspond to one source. To be freed. */
cage cage_between(const cage *a, const cage *b, double share);

#endif
