/* Cutting edges inside the mesh of a map in space in the middle, before and after the map. */
#ifndef ICCP_SOLID_CUTS_H
#define ICCP_SOLID_CUTS_H

#include "map/solid/solid_edit.h"

/* The edges from boundary to boundary, the longest first, as far as they have no tetrahedron in
 * common. */
icc_status iccp_solid_halve_chords(iccp_solid_edit *edit, size_t *n_cut);

/* The edges inside of tetrahedra that are not positive after the map, as these cuts may leave them,
 * the longest first; likewise. */
icc_status iccp_solid_halve_inverted(iccp_solid_edit *edit, size_t *n_cut);

/* The longest edge of each of the tetrahedra with the most energy above an isometry's, a fifth of
 * all; likewise. */
icc_status iccp_solid_halve_worst(iccp_solid_edit *edit, size_t *n_cut);

#endif
