/* Cuts chords: edges of a mesh that cross the inside from boundary to boundary. If all corners of a
 * simplex are on the boundary, the target fixes its image, and no repair can change it. */
#ifndef ICCP_SOLID_CHORDS_H
#define ICCP_SOLID_CHORDS_H

#include "geometry/simplices.h"

/* Makes a mesh with a point in the middle of every chord. Facets are given by their points. The new
 * mesh does not have the caller's numbers. *out is NULL, with ICC_OK, if there are no chords or if
 * a piece would be flat. O(n). */
icc_status iccp_solid_cut_chords(iccp_simplices **out, const iccp_simplices *mesh,
                                 const uint32_t *facets, const iccp_env *env);

#endif
