/* Decides which contours of a path are outlines, and which are holes in which outline. */
#ifndef CONTOURS_H
#define CONTOURS_H

#include "cage/cage.h"

/* Makes polygons of all vertices of `out`. Contour k begins at vertex firsts[k], the last one ends
 * with the vertices, and each has at least three. A contour inside no other is an outline. One
 * inside an outline is a hole of it, and one inside a hole is an outline again. The first outline
 * is the cage, and the others are its further polygons. Outlines, and holes of one outline, keep
 * their order. Crossing or touching contours are found later, when domains are checked. */
void cage_take_contours(cage *out, size_t n, const size_t *firsts);

#endif
