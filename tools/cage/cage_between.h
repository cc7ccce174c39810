/* Makes cages between two others. */
#ifndef CAGE_BETWEEN_H
#define CAGE_BETWEEN_H

#include "cage/cage.h"

/* Returns the polygon at a share, between 0 and 1, of the straight way from `a` to `b`. It includes
 * holes and points, but no lines and ties. Both correspond to one source. Free it. */
cage cage_between(const cage *a, const cage *b, double share);

#endif
