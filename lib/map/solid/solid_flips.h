/* Flips in a map of a mesh in space. */
#ifndef ICCP_SOLID_FLIPS_H
#define ICCP_SOLID_FLIPS_H

#include "map/solid/solid_edit.h"

/* Replaces tetrahedra round an edge by others without it, and two that share a face by three,
 * wherever all are positive, before and after, and the energy falls; again until that happens
 * hardly any more. ICC_ERR_CANCELLED leaves a mesh, too. */
icc_status iccp_solid_flip(iccp_solid_edit *edit, size_t *n_flips, const iccp_env *env);

#endif
