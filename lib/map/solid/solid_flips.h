/* Improves a map of a mesh in space by flips. */
#ifndef ICCP_SOLID_FLIPS_H
#define ICCP_SOLID_FLIPS_H

#include "map/solid/solid_edit.h"

/* Replaces the tetrahedra around an edge by others without it, and two that share a face by three.
 * All must be positive, before and after the map, and the energy must fall. Repeats this until
 * hardly any flip is left. The mesh is valid after ICC_ERR_CANCELLED, too. */
icc_status iccp_solid_flip(iccp_solid_edit *edit, size_t *n_flips, const iccp_env *env);

#endif
