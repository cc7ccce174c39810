/* Cuts what has only fixed corners. If all corners of a simplex are fixed, the target fixes its
 * image, and no repair can change it. If all corners of an inner facet are fixed and lie in a face
 * of the target, the simplices beside it have no room. */
#ifndef ICCP_SOLID_CHORDS_H
#define ICCP_SOLID_CHORDS_H

#include "map/solid/solid_marks.h"

/* Makes a mesh with a point in the middle of every chord (an edge with fixed ends that is not
 * marked), of every neck (a facet with fixed corners and without chords that is not marked), and of
 * every simplex with fixed corners that is left. Points keep their numbers, and new ones follow.
 * The new mesh does not have the caller's numbers, and does not know its neighbours. *out is NULL,
 * with ICC_OK, if there is nothing to cut or if a piece would be flat. O(n). */
icc_status iccp_solid_cut_chords(iccp_simplices **out, const iccp_simplices *mesh,
                                 const iccp_solid_marks *marks, const iccp_env *env);

#endif
