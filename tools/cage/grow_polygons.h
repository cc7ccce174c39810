/* Moves closed polygons outwards. */
#ifndef GROW_POLYGONS_H
#define GROW_POLYGONS_H

#include <stddef.h>

/* Moves the vertices of closed polygons that neither cross nor touch, so that their sides move
 * outwards by up to `distance`. The inside lies to the left of each side as a picture is seen, with y
 * down. A vertex takes at most a third of the way to what lies across a gap, and stays in the box
 * from 0, 0 to `box`. Polygons that turn sharply may cross afterwards, so check them. */
void grow_polygons(double *points, size_t n, const size_t *firsts, size_t n_polygons,
                   double distance, const double box[2]);

#endif
