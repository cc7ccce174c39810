/* Tells which contours of a path are outlines, and which are holes in which outline. */
#ifndef CONTOURS_H
#define CONTOURS_H

#include "cage/cage.h"

/* Makes polygons of all vertices of `out`. Contour k begins at vertex firsts[k], the last one ends with
 * the vertices, and each has three or more. A contour in no other one is an outline. One in an outline
 * is a hole of it, and one in a hole is an outline again. The first outline is the cage, and the others
 * are its further polygons. Outlines, and holes of one outline, keep their order. Contours that cross
 * or touch are found later, when domains are checked. */
void cage_take_contours(cage *out, size_t n, const size_t *firsts);

#endif
