/* A piecewise linear map drawn anew where a few triangles cannot be untangled. */
#ifndef ICCP_REDRAW_H
#define ICCP_REDRAW_H

#include "map/compatible/plmap.h"
#include "map/energy/work.h"

/* Puts other triangles in the place of patches round triangles whose images are not positive:
 * their borders stay, before and after the map, and all inside is positive on both sides, exactly.
 * A patch is a disc without anything fixed inside, whose border is a simple polygon after the map,
 * too; where no small one is, what is left is counted in `n_left`. The vertices and triangles of
 * the map are numbered anew. O(n) for each patch. */
icc_status iccp_redraw(iccp_plmap *map, iccp_work *work, size_t *n_left, const iccp_env *env);

#endif
