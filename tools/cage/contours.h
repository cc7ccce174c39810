/* The contours of a path in the plane: which are outlines, and which are holes in which outline. */
#ifndef CONTOURS_H
#define CONTOURS_H

#include "cage/cage.h"

/* Makes polygons of all vertices of `out`. Contour k begins at vertex firsts[k], the last one ends with
 * the vertices, and each has three or more. A contour in no other one is an outline. One in an outline
 * is a hole of it, and one in a hole is an outline again. The first outline is the cage, the others are
 * more of it; outlines, and holes of one outline, keep their order. What crosses or touches is not told
 * from the rest here: domains are checked afterwards. */
void cage_take_contours(cage *out, size_t n, const size_t *firsts);

#endif
