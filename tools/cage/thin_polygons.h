/* Simplifies closed polygons within a distance. */
#ifndef THIN_POLYGONS_H
#define THIN_POLYGONS_H

#include <stddef.h>

/* Removes vertices of closed polygons that neither cross nor touch, so that they still do
 * neither, and every removed vertex lies within `distance` of the side in its place. Each
 * polygon keeps at least three vertices. Moves what stays to the front of `points` and `firsts`,
 * and returns the number of vertices. */
size_t thin_polygons(double *points, size_t n, size_t *firsts, size_t n_polygons, double distance);

#endif
