/* Vertices that have no point below: their images are raised from the ball to the target. */
#ifndef ICCP_COAT_RAISE_H
#define ICCP_COAT_RAISE_H

#include "map/solid/coat.h"
#include "map/solid/cone.h"

/* Moves the image of a vertex of the boundary, away from the apex, to a place in its direction; all
 * tetrahedra have to be in place. False where that is not possible; the mesh may be finer then. */
bool iccp_coat_raise(iccp_cone *cone, const uint32_t *below, uint32_t vertex, const double apex[3],
                     const double place[3]);

#endif
