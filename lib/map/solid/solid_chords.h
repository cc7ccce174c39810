/* Cutting the edges of a mesh that cross the inside from boundary to boundary: where all corners of
 * a simplex are on the boundary, its image is what the target makes of them, and no repair can
 * help. */
#ifndef ICCP_SOLID_CHORDS_H
#define ICCP_SOLID_CHORDS_H

#include "geometry/simplices.h"

/* A mesh with a point in the middle of every such edge, whose facets are given by their points. It
 * does not know the caller's numbers. *out is NULL, with ICC_OK, if there are none or a piece would
 * be flat. O(n). */
icc_status iccp_solid_cut_chords(iccp_simplices **out, const iccp_simplices *mesh,
                                 const uint32_t *facets, const iccp_env *env);

#endif
