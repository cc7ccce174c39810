/* Raises the images of vertices without a point below, from the ball to the target. */
#ifndef ICCP_COAT_RAISE_H
#define ICCP_COAT_RAISE_H

#include "map/solid/coat.h"
#include "map/solid/coat_mesh.h"

/* Moves the image of a boundary vertex away from the apex to a place in its direction. All
 * tetrahedra must be in place. Returns false if this is impossible; the mesh may be finer then. */
bool iccp_coat_raise(iccp_coat_mesh *mesh, const uint32_t *below, uint32_t vertex,
                     const double apex[3], const double place[3]);

#endif
