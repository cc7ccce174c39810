/* Cuts inner edges of the mesh of a map in space in the middle, before and after the map. */
#ifndef ICCP_SOLID_CUTS_H
#define ICCP_SOLID_CUTS_H

#include "map/solid/solid_edit.h"

/* Cuts the chords (edges from boundary to boundary), the longest first. Cuts in one pass have no
 * tetrahedron in common. */
icc_status iccp_solid_halve_chords(iccp_solid_edit *edit, size_t *n_cut);

/* Cuts the longest edge of each of the worst 20 % of the tetrahedra, by energy above an isometry's.
 * Cuts in one pass have no tetrahedron in common. */
icc_status iccp_solid_halve_worst(iccp_solid_edit *edit, size_t *n_cut);

#endif
